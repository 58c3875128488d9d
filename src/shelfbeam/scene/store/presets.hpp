#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/fields/problems.hpp"
#include "shelfbeam/base/json.hpp"

namespace shelfbeam {

/// Named beginnings of fixtures, from the store file and its catalogues.
class Presets {
 public:
  /// Adds the members of an object "presets". Collects problems of names that another file has used, and of
  /// keys that no fixture has, which it then drops.
  void add(const JsonCursor& section, Problems& problems);

  std::vector<std::string> names() const;

  /// Collects problems of presets that refer to an unknown preset or to themselves. Requires all presets.
  void check(Problems& problems);

  /// Counts the values that a fixture will take from its preset. Throws InputError if all fixtures so far
  /// take too many: copying them would need much time and memory.
  void take(const JsonCursor& fixture);

  /// The fixture with the keys of its preset that it lacks; objects within it are completed in the same way.
  /// Errors in a key of a preset name the preset. A fixture without "preset" is returned unchanged. Throws
  /// InputError for an unknown preset.
  JsonCursor complete(const JsonCursor& fixture) const;

 private:
  using Named = std::pair<std::string, JsonCursor>;

  /// The preset of a fixture or preset, the preset of that preset, and so on. `name`: of a preset.
  std::vector<Named> chain_of(const JsonCursor& json, const std::string* name = nullptr) const;
  void fail_unknown(const JsonCursor& reference, const std::string& name) const;

  std::map<std::string, JsonCursor, std::less<>> presets_;
  std::map<std::string, std::size_t, std::less<>> sizes_;  ///< number of values, by preset
  std::map<std::string, std::size_t, std::less<>> taken_;  ///< the same with those of its chain
  Problems* problems_ = nullptr;                           ///< of the last call with problems
  std::size_t copied_ = 0;                                 ///< values, into all fixtures
};

}  // namespace shelfbeam
