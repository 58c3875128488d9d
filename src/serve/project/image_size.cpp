#include "serve/project/image_size.hpp"

#include <cstddef>

namespace shelfbeam::serve {

namespace {

// Numbers of a file. A picture that ends before they do is incomplete.
class Bytes {
 public:
  explicit Bytes(std::string_view content) : content_(content) {}

  std::optional<std::uint64_t> number(std::size_t at, std::size_t count, bool is_big) const {
    if (at > content_.size() || count > content_.size() - at) return {};
    std::uint64_t value = 0;
    for (std::size_t k = 0; k < count; ++k)
      value = value << 8 | static_cast<unsigned char>(content_[at + (is_big ? k : count - 1 - k)]);
    return value;
  }
  std::optional<std::uint64_t> big(std::size_t at, std::size_t count) const {
    return number(at, count, true);
  }
  std::optional<std::uint64_t> little(std::size_t at, std::size_t count) const {
    return number(at, count, false);
  }
  std::string_view part(std::size_t at, std::size_t count) const {
    return at <= content_.size() ? content_.substr(at, count) : std::string_view();
  }
  std::size_t size() const { return content_.size(); }
  bool contains(std::string_view mark) const { return content_.find(mark) != std::string_view::npos; }

 private:
  std::string_view content_;
};

}  // namespace

// The chunks of a PNG file up to IEND.
std::optional<ImageSize> size_of_png(std::string_view content) {
  const Bytes file(content);
  const auto width = file.big(16, 4), height = file.big(20, 4);
  if (file.part(12, 4) != "IHDR" || !width || !height) return {};
  std::size_t at = 8;  // after the mark
  while (const auto length = file.big(at, 4)) {
    const std::string_view type = file.part(at + 4, 4);
    at += 12 + *length;
    if (at > file.size()) return {};
    if (type == "IEND") return ImageSize{*width, *height};
  }
  return {};
}

// The segments of a JPEG file up to the data, and the mark at the end of the data.
std::optional<ImageSize> size_of_jpeg(std::string_view content) {
  const Bytes file(content);
  std::optional<ImageSize> size;
  std::size_t at = 2;
  while (const auto mark = file.big(at, 2)) {
    const auto code = static_cast<unsigned>(*mark & 0xff);
    if (*mark >> 8 != 0xff) return {};
    if (code == 0xff) {  // a byte that fills
      ++at;
      continue;
    }
    const auto length = file.big(at + 2, 2);
    if (!length) return {};
    const bool is_frame = code >= 0xc0 && code <= 0xcf && code != 0xc4 && code != 0xc8 && code != 0xcc;
    if (is_frame) {
      const auto height = file.big(at + 5, 2), width = file.big(at + 7, 2);
      if (!height || !width) return {};
      size = ImageSize{*width, *height};
    }
    at += 2 + *length;
    if (code == 0xda) return Bytes(file.part(at, file.size())).contains("\xff\xd9") ? size : std::nullopt;
  }
  return {};
}

std::optional<ImageSize> size_of_webp(std::string_view content) {
  const Bytes file(content);
  const auto length = file.little(4, 4);
  if (!length || *length + 8 > file.size()) return {};
  const std::string_view form = file.part(12, 4);
  const auto plus_one = [](std::optional<std::uint64_t> value) { return value ? *value + 1 : 0; };
  if (form == "VP8X") return ImageSize{plus_one(file.little(24, 3)), plus_one(file.little(27, 3))};
  if (form == "VP8L") {
    const auto bits = file.little(21, 4);
    if (!bits) return {};
    return ImageSize{(*bits & 0x3fff) + 1, (*bits >> 14 & 0x3fff) + 1};
  }
  const auto width = file.little(26, 2), height = file.little(28, 2);
  if (form != "VP8 " || !width || !height) return {};
  return ImageSize{*width & 0x3fff, *height & 0x3fff};
}

}  // namespace shelfbeam::serve
