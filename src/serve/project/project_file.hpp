#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace shelfbeam::serve {

/// A file that a person has added to the folder of a project.
struct ProjectFile {
  std::string name;                     ///< in the folder
  std::uint32_t width = 0, height = 0;  ///< of a picture
  bool is_new = false;                  ///< the folder did not have it
};

/// Browsers show no larger pictures.
inline constexpr std::uint64_t max_file_bytes = 200ULL << 20, max_picture_pixels = 100'000'000;

/// Keeps the content of a file in a folder, as `name` or, because a file never changes under its name, with a
/// number in it if other content has the name: a PNG, JPEG, WEBP, PDF, DXF, CSV, IES, LDT, GLB, OBJ, STL or
/// PLY file. A CSV file is UTF-8 without control characters other than tab, CR and LF. Throws InputError for
/// a name that is not of letters, digits, '.', '-' and '_' with an extension of its format, and for pictures
/// that are incomplete or too large.
ProjectFile keep_file(const std::filesystem::path& folder, std::string_view name, std::string_view content);

struct StoredFile {
  std::string_view type;  ///< media type
  std::string content;
};

/// Nothing if the folder has no regular file of this name or the file has none of these formats.
std::optional<StoredFile> stored_file(const std::filesystem::path& folder, std::string_view name);

}  // namespace shelfbeam::serve
