#pragma once

#include <set>
#include <string>

#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

/// Checks the extensions of a glTF file, so that none that moves, adds or hides surfaces is ignored.
class GltfExtensions {
 public:
  /// Checks those that the file declares. Throws InputError for an extension that is not supported: one that
  /// is known to change surfaces, or an unknown one that the file requires.
  explicit GltfExtensions(const JsonCursor& root);

  /// The same for those of an object of the file, which may lack a declaration.
  void check(const JsonCursor& object);

  /// Unknown extensions without which, according to the file, a reader can do.
  const std::set<std::string>& unknown() const { return unknown_; }

 private:
  void check_name(const std::string& name, bool is_required, const JsonCursor& place);

  std::set<std::string> unknown_;
};

}  // namespace shelfbeam
