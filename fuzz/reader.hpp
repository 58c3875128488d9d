#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace shelfbeam::fuzz {

/// A reader of untrusted files. To add a reader, define it in a file beside this one, and add a line to
/// reader.cpp and its name to CMakeLists.txt.
struct Reader {
  std::string_view name;
  /// Reads the bytes as a file. Returns or throws InputError; any other outcome is a finding.
  void (*read)(std::string_view bytes);
  /// Small valid files.
  std::vector<std::string> (*seeds)();
  /// Corrects checksums and lengths, so that the reader accepts mutated bytes; keeps the size.
  void (*repair)(std::string& bytes) = nullptr;
};

std::span<const Reader> readers();

/// The reader of that name, or nullptr.
const Reader* find_reader(std::string_view name);

/// A text as other programs save it: with a byte order mark, with CR at the ends of lines, in UTF-16.
std::vector<std::string> foreign_texts(const std::string& text);

/// A file of the source tree.
std::string source_file(std::string_view path);

}  // namespace shelfbeam::fuzz
