#include "serve/http/target.hpp"

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve::http {

namespace {

int hexadecimal(char digit) {
  if (digit >= '0' && digit <= '9') return digit - '0';
  if (digit >= 'a' && digit <= 'f') return digit - 'a' + 10;
  if (digit >= 'A' && digit <= 'F') return digit - 'A' + 10;
  return -1;
}

std::optional<std::string> decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '?' || c == '#') return std::nullopt;
    if (c == '%') {
      const int high = i + 2 < text.size() ? hexadecimal(text[i + 1]) : -1;
      const int low = i + 2 < text.size() ? hexadecimal(text[i + 2]) : -1;
      if (high < 0 || low < 0) return std::nullopt;
      c = static_cast<char>(16 * high + low);
      i += 2;
      if (c == '/' || c == '%') return std::nullopt;
    }
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code > 0x7e || c == '\\') return std::nullopt;
    out += c;
  }
  return out;
}

}  // namespace

std::optional<Target> parse_target(std::string_view text) {
  if (!text.starts_with('/')) return std::nullopt;
  const std::optional<std::string> path = decoded(text.substr(1));
  if (!path) return std::nullopt;
  const std::size_t slash = path->find('/');
  if (slash == std::string::npos) return std::nullopt;
  Target target{path->substr(0, slash), path->substr(slash + 1)};
  if (target.name.empty()) return target;
  std::string_view rest = target.name;
  while (true) {
    const std::size_t end = rest.find('/');
    const std::string_view segment = rest.substr(0, end);
    if (segment.empty() || segment == "." || segment == "..") return std::nullopt;
    if (end == std::string_view::npos) return target;
    rest.remove_prefix(end + 1);
  }
}

}  // namespace shelfbeam::serve::http
