#include "serve/project/picture_file.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/project/regular_file.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

struct Size {
  std::uint64_t width = 0, height = 0;
};

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

constexpr std::string_view png_mark = "\x89PNG\r\n\x1a\n";

// The chunks of a PNG file up to IEND.
std::optional<Size> size_of_png(const Bytes& file) {
  const auto width = file.big(16, 4), height = file.big(20, 4);
  if (file.part(12, 4) != "IHDR" || !width || !height) return {};
  std::size_t at = png_mark.size();
  while (const auto length = file.big(at, 4)) {
    const std::string_view type = file.part(at + 4, 4);
    at += 12 + *length;
    if (at > file.size()) return {};
    if (type == "IEND") return Size{*width, *height};
  }
  return {};
}

// The segments of a JPEG file up to the data, and the mark at the end of the data.
std::optional<Size> size_of_jpeg(const Bytes& file) {
  std::optional<Size> size;
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
      size = Size{*width, *height};
    }
    at += 2 + *length;
    if (code == 0xda) return Bytes(file.part(at, file.size())).contains("\xff\xd9") ? size : std::nullopt;
  }
  return {};
}

std::optional<Size> size_of_webp(const Bytes& file) {
  const auto length = file.little(4, 4);
  if (!length || *length + 8 > file.size()) return {};
  const std::string_view form = file.part(12, 4);
  const auto plus_one = [](std::optional<std::uint64_t> value) { return value ? *value + 1 : 0; };
  if (form == "VP8X") return Size{plus_one(file.little(24, 3)), plus_one(file.little(27, 3))};
  if (form == "VP8L") {
    const auto bits = file.little(21, 4);
    if (!bits) return {};
    return Size{(*bits & 0x3fff) + 1, (*bits >> 14 & 0x3fff) + 1};
  }
  const auto width = file.little(26, 2), height = file.little(28, 2);
  if (form != "VP8 " || !width || !height) return {};
  return Size{*width & 0x3fff, *height & 0x3fff};
}

struct Format {
  std::string_view name, type;
  std::vector<std::string_view> extensions;
  bool (*matches)(const Bytes&);
  std::optional<Size> (*size)(const Bytes&);
};

const std::array<Format, 3>& formats() {
  static const std::array<Format, 3> all{
      {{"PNG",
        "image/png",
        {".png"},
        [](const Bytes& file) { return file.part(0, 8) == png_mark; },
        size_of_png},
       {"JPEG",
        "image/jpeg",
        {".jpg", ".jpeg"},
        [](const Bytes& file) { return file.part(0, 3) == "\xff\xd8\xff"; },
        size_of_jpeg},
       {"WEBP",
        "image/webp",
        {".webp"},
        [](const Bytes& file) { return file.part(0, 4) == "RIFF" && file.part(8, 4) == "WEBP"; },
        size_of_webp}}};
  return all;
}

const Format* format_of(std::string_view content) {
  const Bytes file(content);
  const auto found = std::ranges::find_if(formats(), [&](const Format& one) { return one.matches(file); });
  return found == formats().end() ? nullptr : &*found;
}

bool has_extension(const Format& format, std::string_view name) {
  return std::ranges::count(format.extensions, lower_case(fs::path(name).extension().string())) > 0;
}

bool is_plain(std::string_view name) {
  constexpr std::string_view known = "-._0123456789abcdefghijklmnopqrstuvwxyz";
  return !name.empty() && name.size() <= 100 && name.front() != '.' &&
         lower_case(name).find_first_not_of(known) == std::string::npos;
}

// "plan.png", "plan-2.png", ...
std::string numbered(const std::string& name, int number) {
  const fs::path path(name);
  return number == 1 ? name : fmt::format("{}-{}{}", path.stem().string(), number, path.extension().string());
}

}  // namespace

PictureFile keep_picture(const fs::path& folder, std::string_view name, std::string_view content) {
  const std::string own(name);
  if (!is_plain(own))
    throw InputError("the name of the picture", "is not of letters, digits, '.', '-' and '_'", "rename it");
  const Format* format = format_of(content);
  if (format == nullptr)
    throw InputError(own, "is not a PNG, JPEG or WEBP picture", "export the floor plan as one of these");
  if (!has_extension(*format, own))
    throw InputError(own, fmt::format("is a {} picture", format->name),
                     fmt::format("rename it to {}{}", fs::path(own).stem().string(), format->extensions[0]));
  const auto size = format->size(Bytes(content));
  if (!size || size->width == 0 || size->height == 0)
    throw InputError(own, "is incomplete or damaged", "export it again");
  if (size->width > max_picture_pixels / size->height)
    throw InputError(own,
                     fmt::format("has {} x {} pixels; the maximum is {} million pixels", size->width,
                                 size->height, max_picture_pixels / 1'000'000),
                     "export it with a lower resolution: 100 pixels per metre are enough");
  for (int number = 1;; ++number) {
    std::string free = numbered(own, number);
    const fs::path path = folder / free;
    if (stamp_of(path)) {
      const auto known = read_picture(folder, free);
      if (!known || known->content != content) continue;
    } else {
      write_file(path, content);
    }
    return {std::move(free), static_cast<std::uint32_t>(size->width),
            static_cast<std::uint32_t>(size->height)};
  }
}

std::optional<PictureContent> read_picture(const fs::path& folder, std::string_view name) {
  if (!is_plain(name)) return {};
  try {
    auto file = read_regular_file(folder / name, max_picture_bytes);
    const Format* format = file ? format_of(file->content) : nullptr;
    if (format == nullptr || !has_extension(*format, name)) return {};
    return PictureContent{format->type, std::move(file->content)};
  } catch (const InputError&) {  // a link, a folder, or a file that is too large
    return {};
  }
}

}  // namespace shelfbeam::serve
