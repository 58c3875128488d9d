#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/memory.hpp"

namespace shelfbeam::detail {

/// Default limit for texts, bytes: at most 1 GiB. A matrix takes several times the memory of its text.
inline std::size_t max_text_bytes() {
  return std::min<std::size_t>(memory_limit() / 8, max_text_file);
}

/// The whole file, decompressed if it is gzip, without a UTF-8 byte order mark. Throws InputError if the file
/// cannot be read, is a truncated or corrupt gzip file, is not text, or has more than `max_bytes` bytes after
/// decompression, or more than 256 MiB and a hundred times the size of the gzip file.
std::string read_text_file(const std::filesystem::path& path, std::size_t max_bytes = max_text_bytes());

/// The first `count` bytes of the file, or fewer if it is shorter. Throws InputError if it cannot be read.
std::string read_first_bytes(const std::filesystem::path& path, std::size_t count);

}  // namespace shelfbeam::detail
