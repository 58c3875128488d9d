#pragma once

#include <string>
#include <string_view>

namespace shelfbeam::test {

/// The text with other ends of lines.
inline std::string with_line_ends(std::string_view text, std::string_view end) {
  std::string result;
  for (const char c : text) result += c == '\n' ? end : std::string_view(&c, 1);
  return result;
}

/// The ASCII text in UTF-16, little-endian and with its mark.
inline std::string in_utf16(std::string_view text) {
  std::string result = "\xFF\xFE";
  for (const char c : text) result += {c, '\0'};
  return result;
}

}  // namespace shelfbeam::test
