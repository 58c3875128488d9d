#include "serve/text/token.hpp"

#include <algorithm>

#include "serve/text/gap.hpp"

namespace shelfbeam::serve {

std::size_t quoted_end(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at)
    if (text[at] == '\\') ++at;
  return std::min(at + 1, text.size());
}

std::size_t value_end(std::string_view text, std::size_t at) {
  constexpr std::string_view behind_scalar(",:]}/ \t\r\n\0", 10);
  std::size_t levels = 0;
  do {
    at = gap_end(text, at);
    if (at >= text.size()) return at;
    const char c = text[at];
    if (c == '"') {
      at = quoted_end(text, at);
    } else if (c == '{' || c == '[') {
      ++levels;
      ++at;
    } else if (c == '}' || c == ']') {
      --levels;
      ++at;
    } else if (c == ',' || c == ':') {
      ++at;
    } else {
      at = std::min(text.find_first_of(behind_scalar, at), text.size());
    }
  } while (levels > 0);
  return at;
}

}  // namespace shelfbeam::serve
