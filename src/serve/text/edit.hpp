#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/error.hpp"

#include "serve/text/json_value.hpp"
#include "serve/text/splice.hpp"

namespace shelfbeam::serve {

/// One change of a value. Without `before`, the value is inserted: into an object at its end, into a list
/// before that index, which may be the size of the list. Without `after`, the value is removed.
struct EditOp {
  std::string path;  ///< JSON pointer (RFC 6901)
  std::optional<Json> before, after;
};

/// An operation does not fit the text.
class EditConflict : public InputError {
 public:
  EditConflict(const std::string& path, const std::string& reason)
      : InputError(path.empty() ? "the whole value" : path, reason), path_(path), reason_(reason) {}

  const std::string& path() const { return path_; }
  const std::string& reason() const { return reason_; }

 private:
  std::string path_, reason_;
};

struct EditedText {
  std::string text;
  Json value;                   ///< of the text
  std::vector<Splice> splices;  ///< that make it from the text before
};

/// Applies the operations one after the other to a JSON text, which may have comments and a byte order mark.
/// Comments, layout and the order of keys stay as they are, except for what belongs to removed values
/// (tree_edit.hpp); equal parts of a new and an old object or list are not written anew. Values are compared
/// as JSON, so 1 is 1.0.
///
/// Throws InputError if `parse_json` does not read the text, and EditConflict if `before` is not what is at
/// the place, if the place does not exist or is not free, or if the result would break a limit of
/// `parse_json`.
EditedText edited(std::string_view text, const std::vector<EditOp>& ops);

}  // namespace shelfbeam::serve
