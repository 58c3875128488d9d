#pragma once

#include <map>
#include <string>
#include <vector>

#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

/// Named beginnings of fixtures, from the store file and its catalogues.
class Presets {
 public:
  /// Adds the members of an object "presets". Throws InputError for a name that another file has used.
  void add(const JsonCursor& section);

  /// The fixture with the keys of its preset that it lacks; objects within it are completed in the same way.
  /// The same cursor without the key "preset". Throws InputError for an unknown preset and for presets that
  /// refer to themselves.
  JsonCursor complete(const JsonCursor& fixture) const;

 private:
  [[noreturn]] void fail_unknown(const JsonCursor& reference, const std::string& name) const;

  std::map<std::string, JsonCursor, std::less<>> presets_;
};

}  // namespace shelfbeam
