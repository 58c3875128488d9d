#include "shelfbeam/report/mounting/cad_text.hpp"

#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

// No id or name contains it.
constexpr std::uint32_t zero_width_space = 0x200B;

std::string escaped(std::uint32_t code) {
  constexpr std::uint32_t beyond = 0x10000;
  if (code < beyond) return fmt::format("\\U+{:04X}", code);
  // The code has four digits, for a unit of UTF-16.
  return fmt::format("\\U+{:04X}\\U+{:04X}", 0xD800 + ((code - beyond) >> 10U),
                     0xDC00 + ((code - beyond) & 0x3FFU));
}

}  // namespace

std::string cad_text(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    const Character character = character_at(text, i);
    const std::uint32_t code = character.code;
    const bool is_outer_blank = code == ' ' && (i == 0 || i + 1 == text.size());
    if (code < 0x20 || code >= 0x7F || code == '\\' || is_outer_blank)
      result += escaped(code);
    else if (code == '^')
      result += "^ ";
    else if (code == '%' && text.substr(i + 1).starts_with('%'))
      result += '%' + escaped(zero_width_space);
    else
      result += static_cast<char>(code);
    i += character.bytes;
  }
  return result;
}

}  // namespace shelfbeam
