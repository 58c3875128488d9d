#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace shelfbeam {

/// Maximum size of the file of a picture, bytes. The report contains the picture of every type.
inline constexpr std::uint64_t max_picture_file = 500'000;

/// The content of a PNG, JPEG or SVG file as a data URI, which a page contains; nothing for other contents.
std::optional<std::string> picture_uri(std::string_view content);

/// Whether a text is the data URI of such a picture, and no larger than one of a file.
bool is_picture_uri(std::string_view text);

}  // namespace shelfbeam
