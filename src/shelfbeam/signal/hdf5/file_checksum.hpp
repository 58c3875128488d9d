#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

// The HDF5 library trusts its files more than it may. So a file that we write begins with a line of text that
// holds the XXH3-128 of all bytes behind the line, and damage is found before the library sees it.

namespace shelfbeam::detail {

/// The line and zeros behind it. HDF5 leaves such a "user block" alone; it takes no smaller one.
inline constexpr std::size_t checksum_block = 512;

/// Whether the file begins with a checksum. Throws InputError when it cannot be read.
bool has_file_checksum(const std::filesystem::path& path);

/// Fills the block of a file that is complete otherwise; `name` stands for the file in errors. Throws
/// OutputError.
void write_file_checksum(const std::filesystem::path& path, const std::string& name);

/// Throws InputError unless all bytes of a file that has a checksum are those that were written.
void verify_file_checksum(const std::filesystem::path& path);

}  // namespace shelfbeam::detail
