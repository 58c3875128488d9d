#include "shelfbeam/device/picture.hpp"

#include <algorithm>
#include <array>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

constexpr std::string_view png = "data:image/png;base64,", jpeg = "data:image/jpeg;base64,",
                           svg = "data:image/svg+xml;base64,";

// The element may follow a declaration and comments.
bool is_svg(std::string_view content) {
  constexpr std::size_t head = 2000;
  const std::string_view begin = trim(content.substr(0, head));
  return begin.starts_with('<') && begin.find("<svg") != std::string_view::npos && is_utf8(content);
}

std::string_view prefix_of(std::string_view content) {
  constexpr std::string_view png_mark = "\x89PNG\r\n\x1a\n", jpeg_mark = "\xff\xd8\xff",
                             text_mark = "\xef\xbb\xbf";
  if (content.starts_with(png_mark)) return png;
  if (content.starts_with(jpeg_mark)) return jpeg;
  if (content.starts_with(text_mark)) content.remove_prefix(text_mark.size());
  return is_svg(content) ? svg : std::string_view();
}

bool is_digit_of_base64(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '+' || c == '/';
}

}  // namespace

std::optional<std::string> picture_uri(std::string_view content) {
  const std::string_view prefix = prefix_of(content);
  if (prefix.empty() || content.size() > max_picture_file) return {};
  return std::string(prefix) + to_base64(content);
}

bool is_picture_uri(std::string_view text) {
  for (const std::string_view prefix : {png, jpeg, svg}) {
    if (!text.starts_with(prefix)) continue;
    std::string_view digits = text.substr(prefix.size());
    if (digits.empty() || digits.size() % 4 != 0 || digits.size() / 4 * 3 > max_picture_file + 2)
      return false;
    for (int padding = 0; padding < 2 && digits.ends_with('='); ++padding) digits.remove_suffix(1);
    return std::all_of(digits.begin(), digits.end(), is_digit_of_base64);
  }
  return false;
}

}  // namespace shelfbeam
