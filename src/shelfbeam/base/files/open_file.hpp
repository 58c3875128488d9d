#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/files/descriptor.hpp"

namespace shelfbeam {

/// Opens an empty file in the folder that has no name, so that it is gone when it is closed, even if the
/// process is killed. Not open if it cannot be made, with the reason in `errno`.
Descriptor open_unnamed(const std::filesystem::path& folder);

/// The first `size` bytes of the open file, or as many as it has; nothing if they cannot be read.
std::optional<std::string> read_open(int descriptor, std::uint64_t size);

/// Whether it is a regular file with this content; does not follow a link in its place.
bool has_content(const std::filesystem::path& path, std::string_view content);

/// Whether the path is the name of the open file, and not of one that has taken its place.
bool names(const std::filesystem::path& path, int descriptor);

/// Writes all bytes at a place of the open file; returns whether it can, with the reason in `errno`.
bool write_at(int descriptor, std::string_view bytes, std::uint64_t place);

}  // namespace shelfbeam
