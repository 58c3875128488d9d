#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/error.hpp"

#include "serve/http/options.hpp"
#include "serve/text/edit.hpp"

namespace shelfbeam::serve {

/// A request of a page (docs/formats/planner.md).
struct Request {
  http::TabId tab;
  Json json;

  /// Throw InputError if the key is missing or has a value of another kind.
  std::string text(const char* key) const;
  std::size_t number(const char* key) const;
  std::vector<EditOp> ops() const;
};

Json json_of(const std::vector<EditOp>& ops);
Json error_json(const InputError& error);

/// The message of a page. Null if it is not JSON, or has so many levels that it is not from our page: to copy
/// a value takes stack for each level.
Json message_of(std::string_view text);

}  // namespace shelfbeam::serve
