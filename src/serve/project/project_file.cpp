#include "serve/project/project_file.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "serve/project/image_size.hpp"
#include "serve/project/regular_file.hpp"

namespace shelfbeam::serve {

namespace fs = std::filesystem;

namespace {

struct Format {
  std::string_view name, type;
  std::vector<std::string_view> extensions;
  bool (*matches)(std::string_view);
  std::optional<ImageSize> (*size)(std::string_view);  // of pictures
  bool is_text = false;                                // the content alone does not show the format
};

bool is_text(std::string_view content) {
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte == 0x7f || (byte < 0x20 && c != '\t' && c != '\n' && c != '\r');
  };
  return !content.empty() && std::ranges::none_of(content, is_control) && is_utf8(content);
}

const std::array<Format, 5>& formats() {
  static const std::array<Format, 5> all{
      {{"a PNG picture",
        "image/png",
        {".png"},
        [](std::string_view file) { return file.starts_with("\x89PNG\r\n\x1a\n"); },
        size_of_png},
       {"a JPEG picture",
        "image/jpeg",
        {".jpg", ".jpeg"},
        [](std::string_view file) { return file.starts_with("\xff\xd8\xff"); },
        size_of_jpeg},
       {"a WEBP picture",
        "image/webp",
        {".webp"},
        [](std::string_view file) {
          return file.starts_with("RIFF") && file.size() >= 12 && file.substr(8, 4) == "WEBP";
        },
        size_of_webp},
       {"a PDF file",
        "application/pdf",
        {".pdf"},
        [](std::string_view file) { return file.starts_with("%PDF-"); },
        nullptr},
       {"a CSV file", "text/csv", {".csv"}, is_text, nullptr, true}}};
  return all;
}

bool has_extension(const Format& format, std::string_view name) {
  return std::ranges::count(format.extensions, lower_case(fs::path(name).extension().string())) > 0;
}

const Format* format_of(std::string_view name, std::string_view content) {
  const auto found = std::ranges::find_if(formats(), [&](const Format& one) {
    return (!one.is_text || has_extension(one, name)) && one.matches(content);
  });
  return found == formats().end() ? nullptr : &*found;
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

ImageSize picture_size(const Format& format, const std::string& name, std::string_view content) {
  const auto size = format.size(content);
  if (!size || size->width == 0 || size->height == 0)
    throw InputError(name, "is incomplete or damaged", "export it again");
  if (size->width > max_picture_pixels / size->height)
    throw InputError(name,
                     fmt::format("has {} x {} pixels; the maximum is {} million pixels", size->width,
                                 size->height, max_picture_pixels / 1'000'000),
                     "export it with a lower resolution: 100 pixels per metre are enough");
  return *size;
}

}  // namespace

ProjectFile keep_file(const fs::path& folder, std::string_view name, std::string_view content) {
  const std::string own(name);
  if (!is_plain(own))
    throw InputError("the name of the file", "is not of letters, digits, '.', '-' and '_'", "rename it");
  const Format* format = format_of(own, content);
  if (format == nullptr)
    throw InputError(own, "is not a PNG, JPEG or WEBP picture, a PDF file or a CSV file in UTF-8",
                     "export it as one of these");
  if (!has_extension(*format, own))
    throw InputError(own, fmt::format("is {}", format->name),
                     fmt::format("rename it to {}{}", fs::path(own).stem().string(), format->extensions[0]));
  const ImageSize size = format->size == nullptr ? ImageSize{} : picture_size(*format, own, content);
  for (int number = 1;; ++number) {
    std::string free = numbered(own, number);
    const fs::path path = folder / free;
    if (stamp_of(path)) {
      const auto known = stored_file(folder, free);
      if (!known || known->content != content) continue;
    } else {
      write_file(path, content);
    }
    return {std::move(free), static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height)};
  }
}

std::optional<StoredFile> stored_file(const fs::path& folder, std::string_view name) {
  if (!is_plain(name)) return {};
  try {
    auto file = read_regular_file(folder / name, max_file_bytes);
    const Format* format = file ? format_of(name, file->content) : nullptr;
    if (format == nullptr || !has_extension(*format, name)) return {};
    return StoredFile{format->type, std::move(file->content)};
  } catch (const InputError&) {  // a link, a folder, or a file that is too large
    return {};
  }
}

}  // namespace shelfbeam::serve
