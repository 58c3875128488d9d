#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

// The HDF5 library is not safe against corrupt files. Files of this program therefore begin with a line with
// the XXH3-128 of all bytes after it, so that corruption is detected before the library opens the file.

namespace shelfbeam::detail {

/// Size of the line and the zeros after it, bytes. It is the smallest "user block", which HDF5 ignores.
inline constexpr std::size_t checksum_block = 512;

/// Whether the file begins with a checksum. Throws InputError when it cannot be read.
bool has_file_checksum(const std::filesystem::path& path);

/// Fills the block of an otherwise complete file. Throws OutputError, which names the file as `name`.
void write_file_checksum(const std::filesystem::path& path, const std::string& name);

/// Throws InputError if the bytes of a file with a checksum do not match it.
void verify_file_checksum(const std::filesystem::path& path);

}  // namespace shelfbeam::detail
