#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam::fuzz {

/// A reader of files that may come from anyone. To add one: a file beside this one that defines it, a line in
/// reader.cpp and its name in CMakeLists.txt.
struct Reader {
  std::string_view name;
  /// Reads the bytes as a file. Returns, or throws InputError; anything else is a finding.
  void (*read)(std::string_view bytes);
  /// Files that it reads, small.
  std::vector<std::string> (*seeds)();
  /// Makes checksums and lengths right again, so that changed bytes get past them; the length stays.
  void (*repair)(std::string& bytes) = nullptr;
};

std::span<const Reader> readers();

/// The reader of that name; nothing when there is none.
const Reader* find_reader(std::string_view name);

/// A file of the source tree.
std::string source_file(std::string_view path);

}  // namespace shelfbeam::fuzz
