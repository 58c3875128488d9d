#include "app/text/width.hpp"

#include <algorithm>
#include <array>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::app {

namespace {

struct Range {
  char32_t first, last;
};

constexpr std::array combining{Range{0x300, 0x36F}, Range{0x200B, 0x200F}, Range{0xFE00, 0xFE0F}};
constexpr std::array wide{Range{0x1100, 0x115F}, Range{0x2E80, 0xA4CF},   Range{0xAC00, 0xD7A3},
                          Range{0xF900, 0xFAFF}, Range{0xFE30, 0xFE6F},   Range{0xFF00, 0xFF60},
                          Range{0xFFE0, 0xFFE6}, Range{0x1F300, 0x1FAFF}, Range{0x20000, 0x3FFFD}};

template <std::size_t Count>
bool contains(const std::array<Range, Count>& ranges, char32_t code) {
  return std::any_of(ranges.begin(), ranges.end(),
                     [code](const Range& range) { return range.first <= code && code <= range.last; });
}

struct Glyph {
  std::string_view bytes;  ///< "?" for bytes that a terminal cannot show
  std::size_t columns;
};

// Removes the first character from a text that is not empty.
Glyph take(std::string_view& text) {
  const auto [code, length, is_printable, is_utf8] = character_at(text, 0);
  const std::string_view bytes = text.substr(0, length);
  text.remove_prefix(length);
  if (!is_utf8 || code < 0x20 || (code >= 0x7F && code < 0xA0)) return {"?", 1};
  return {bytes, contains(combining, code) ? 0U : contains(wide, code) ? 2U : 1U};
}

}  // namespace

std::size_t width_of(std::string_view text) {
  std::size_t columns = 0;
  while (!text.empty()) columns += take(text).columns;
  return columns;
}

std::string fitted(std::string_view text, std::size_t columns) {
  constexpr std::string_view dots = "...";
  const bool is_cut = width_of(text) > columns;
  const std::string_view end = is_cut && columns > 2 * dots.size() ? dots : "";
  std::string result;
  for (std::size_t left = columns - end.size(); !text.empty();) {
    const Glyph next = take(text);
    if (next.columns > left) break;
    left -= next.columns;
    result += next.bytes;
  }
  return result.append(end);
}

}  // namespace shelfbeam::app
