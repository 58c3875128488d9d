#include "serve/project/project_file.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/files/open_file.hpp"
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
  bool is_by_name = false;                             // the content alone does not show the format
};

// Readers of PDF files allow 1024 bytes before the mark: a byte order mark, the header of a transfer, a
// warning of a script.
bool is_pdf(std::string_view file) {
  constexpr std::string_view mark = "%PDF-";
  return file.substr(0, 1024 + mark.size()).find(mark) != std::string_view::npos;
}

// DXF as text begins with group 0, perhaps after comments of group 999.
bool is_dxf(std::string_view file) {
  if (file.starts_with("\xef\xbb\xbf")) file.remove_prefix(3);
  if (file.substr(0, 4096).find('\0') != std::string_view::npos) return false;
  const std::string_view first = file.substr(0, file.find_first_of("\r\n"));
  const std::size_t from = first.find_first_not_of(" \t");
  if (from == std::string_view::npos || first.size() == file.size()) return false;
  const std::string_view code = first.substr(from, first.find_last_not_of(" \t") + 1 - from);
  return code == "0" || code == "999";
}

constexpr std::string_view model_mark = "ISO-10303-21;";

bool is_text(std::string_view content) {
  const auto is_control = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte == 0x7f || (byte < 0x20 && c != '\t' && c != '\n' && c != '\r');
  };
  const bool is_model = content.starts_with(model_mark);
  return !content.empty() && !is_model && std::ranges::none_of(content, is_control) && is_utf8(content);
}

// Readers of the library check the rest.
bool has_content(std::string_view content) {
  return !content.empty();
}

const std::array<Format, 12>& formats() {
  static const std::array<Format, 12> all{
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
       {"a PDF file", "application/pdf", {".pdf"}, is_pdf, nullptr},
       {"a DXF file", "image/vnd.dxf", {".dxf"}, is_dxf, nullptr},
       {"a binary glTF file",
        "model/gltf-binary",
        {".glb"},
        [](std::string_view file) { return file.starts_with("glTF"); },
        nullptr},
       {"a CSV file", "text/csv", {".csv"}, is_text, nullptr, true},
       {"an IES file", "text/plain", {".ies"}, has_content, nullptr, true},
       {"a EULUMDAT file", "text/plain", {".ldt"}, has_content, nullptr, true},
       {"an OBJ file", "model/obj", {".obj"}, has_content, nullptr, true},
       {"an STL file", "model/stl", {".stl"}, has_content, nullptr, true},
       {"a PLY file", "application/octet-stream", {".ply"}, has_content, nullptr, true}}};
  return all;
}

bool has_extension(const Format& format, std::string_view name) {
  return std::ranges::count(format.extensions, lower_case(fs::path(name).extension().string())) > 0;
}

const Format* format_of(std::string_view name, std::string_view content) {
  const auto matches = [&](const Format& one) { return one.matches(content); };
  const auto named = [&](const Format& one) { return has_extension(one, name) && matches(one); };
  auto found = std::ranges::find_if(formats(), named);
  if (found == formats().end())
    found =
        std::ranges::find_if(formats(), [&](const Format& one) { return !one.is_by_name && matches(one); });
  return found == formats().end() ? nullptr : &*found;
}

// Formats that people try, by the beginning of the file.
struct Foreign {
  std::string_view mark, name, remedy;
};
constexpr std::array<Foreign, 5> foreign{
    {{model_mark, "a model (IFC or STEP)", "export the floor plan from it as DXF or PDF"},
     {"AutoCAD Binary DXF", "a binary DXF file", "save it as DXF in text form (ASCII)"},
     {"AC10", "a DWG file", "save it as DXF in the drawing program"},
     {"PK\x03\x04", "a ZIP archive or a spreadsheet", "unpack it, or save the table as CSV"},
     {"\xd0\xcf\x11\xe0", "a document or a spreadsheet",
      "export the floor plan as PDF, or the table as CSV"}}};

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
  if (format == nullptr) {
    for (const auto& [mark, kind, remedy] : foreign)
      if (content.starts_with(mark)) throw InputError(own, fmt::format("is {}", kind), std::string(remedy));
    throw InputError(
        own, "is no file that the planner can use",
        "choose a picture (PNG, JPEG, WEBP), a drawing (PDF, DXF), a table (CSV), an emission profile (IES, "
        "LDT) or a mesh (GLB, OBJ, STL, PLY)");
  }
  if (!has_extension(*format, own))
    throw InputError(own, fmt::format("is {}", format->name),
                     fmt::format("rename it to {}{}", fs::path(own).stem().string(), format->extensions[0]));
  const ImageSize size = format->size == nullptr ? ImageSize{} : picture_size(*format, own, content);
  for (int number = 1;; ++number) {
    std::string free = numbered(own, number);
    const fs::path path = folder / free;
    const bool is_new = !stamp_of(path);
    if (!is_new) {
      if (!shelfbeam::has_content(path, content)) continue;
    } else {
      write_file(path, content);
    }
    return {std::move(free), static_cast<std::uint32_t>(size.width), static_cast<std::uint32_t>(size.height),
            is_new};
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
