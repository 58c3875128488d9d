#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace shelfbeam::serve {

/// Pixels of a picture.
struct ImageSize {
  std::uint64_t width = 0, height = 0;
};

/// Of a file that begins as the format does; nothing if it is incomplete or damaged.
std::optional<ImageSize> size_of_png(std::string_view content);
std::optional<ImageSize> size_of_jpeg(std::string_view content);
std::optional<ImageSize> size_of_webp(std::string_view content);

}  // namespace shelfbeam::serve
