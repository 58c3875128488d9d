#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace shelfbeam::serve {

/// The picture of a floor plan in the folder of a project.
struct PictureFile {
  std::string name;  ///< in the folder
  std::uint32_t width = 0, height = 0;
};

/// Limits of a picture: browsers show no larger ones.
inline constexpr std::uint64_t max_picture_bytes = 64ULL << 20, max_picture_pixels = 100'000'000;

/// Keeps the content of a PNG, JPEG or WEBP file in a folder, as `name` or, because a picture never changes
/// under its name, with a number in it if other content has the name. Throws InputError for a name that is
/// not of letters, digits, '.', '-' and '_' with an extension of its format, and for content that is
/// incomplete or too large.
PictureFile keep_picture(const std::filesystem::path& folder, std::string_view name,
                         std::string_view content);

struct PictureContent {
  std::string_view type;  ///< media type
  std::string content;
};

/// Nothing if the folder has no regular file of this name or the file is no picture.
std::optional<PictureContent> read_picture(const std::filesystem::path& folder, std::string_view name);

}  // namespace shelfbeam::serve
