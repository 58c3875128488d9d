#pragma once

#include <filesystem>
#include <string>

namespace shelfbeam::detail {

/// The whole file, decompressed when it is gzip; a UTF-8 byte order mark is dropped. Throws InputError when
/// it cannot be read, is a truncated or damaged gzip file, or is not text.
std::string read_text_file(const std::filesystem::path& path);

/// The first bytes of the file as they stand in it, at most `count`. Throws InputError when it cannot be
/// read.
std::string read_first_bytes(const std::filesystem::path& path, std::size_t count);

}  // namespace shelfbeam::detail
