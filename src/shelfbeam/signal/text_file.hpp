#pragma once

#include <filesystem>
#include <string>

#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::detail {

/// What a matrix takes in memory is several times its text.
inline std::size_t longest_text() {
  return most_of_the_memory() / 8;
}

/// The whole file, decompressed when it is gzip; a UTF-8 byte order mark is dropped. Throws InputError when
/// it cannot be read, is a truncated or damaged gzip file, or is not text, or has more than `most` bytes when
/// it is decompressed.
std::string read_text_file(const std::filesystem::path& path, std::size_t most = longest_text());

/// The first bytes of the file as they stand in it, at most `count`. Throws InputError when it cannot be
/// read.
std::string read_first_bytes(const std::filesystem::path& path, std::size_t count);

}  // namespace shelfbeam::detail
