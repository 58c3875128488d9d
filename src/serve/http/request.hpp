#pragma once

#include <string_view>
#include <utility>
#include <vector>

namespace shelfbeam::serve::http {

/// The head of a request: views of the bytes of the connection.
struct Request {
  std::string_view method, target;
  /// Names in any case, and values without blanks around them, in the order of the request.
  std::vector<std::pair<std::string_view, std::string_view>> fields;

  /// The values of all fields of a name, which is given in lower case.
  std::vector<std::string_view> values(std::string_view name) const;
  /// Whether a field that is a list with commas ("keep-alive, Upgrade") has the item, which is given in lower
  /// case.
  bool lists(std::string_view name, std::string_view item) const;
};

}  // namespace shelfbeam::serve::http
