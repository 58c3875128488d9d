#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>

#include "shelfbeam/scene/read_scene.hpp"

namespace shelfbeam {

class JsonCursor;

/// The folder of a store file, below which the files lie that it names.
class StoreFolder {
 public:
  explicit StoreFolder(std::filesystem::path folder, const StoreTrust& trust = {});

  /// StoreTrust::memory, but not less than what the program takes by itself.
  std::size_t memory() const { return std::max(trust_.memory, least_memory); }

  /// The file that a text names relative to the folder. Throws InputError at its place where there is none,
  /// or it is a folder, or it lies outside of this one: by "..", as an absolute path or by a symbolic link.
  std::filesystem::path find(const JsonCursor& name) const;
  /// The same for any name; `where` is its place and `what` it should be, "mesh".
  std::filesystem::path find(const std::filesystem::path& name, const std::string& where,
                             const std::string& what) const;

 private:
  static constexpr std::size_t least_memory = 1 << 26;

  std::filesystem::path folder_;
  StoreTrust trust_;
};

}  // namespace shelfbeam
