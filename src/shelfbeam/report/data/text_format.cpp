#include "shelfbeam/report/data/text_format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

struct NumberedId {
  std::string_view prefix, digits;

  explicit NumberedId(std::string_view id) {
    constexpr std::size_t max_digits = 18;  // fits 64 bits
    std::size_t at = id.size();
    while (at > 0 && id.size() - at < max_digits && id[at - 1] >= '0' && id[at - 1] <= '9') --at;
    prefix = id.substr(0, at);
    digits = id.substr(at);
  }

  bool is_followed_by(const NumberedId& next) const {
    if (digits.empty() || next.prefix != prefix) return false;
    std::uint64_t number = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), number);
    return next.digits == fmt::format("{:0{}}", number + 1, digits.size());
  }
};

}  // namespace

std::string escape(std::string_view text) {
  if (!is_utf8(text)) return escape(printable(text));  // of a path in a warning
  std::string out;
  out.reserve(text.size());
  constexpr std::string_view special = "&<>\"'";
  constexpr const char* entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#39;"};
  for (const char c : text) {
    if (const std::size_t k = special.find(c); k != special.npos)
      out += entities[k];
    else if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t')
      out += "\uFFFD";
    else
      out += c;
  }
  return out;
}

std::string with_joined_percent(std::string text) {
  for (std::size_t at = 0; (at = text.find(" %", at)) != std::string::npos;) text.replace(at, 2, "\u00A0%");
  return text;
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

SignalUnit signal_unit(const Words& words, double reference) {
  constexpr std::array<std::pair<double, const char*>, 6> prefixes{
      {{1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}}};
  for (const auto& [factor, prefix] : prefixes)
    if (reference >= factor) return {words, factor, std::string(prefix) + "W/m²"};
  return {words};
}

std::vector<std::string> id_ranges(std::span<const std::string> ids) {
  std::vector<std::string> ranges;
  for (std::size_t first = 0, last = 0; first < ids.size(); first = ++last) {
    while (last + 1 < ids.size() && NumberedId(ids[last]).is_followed_by(NumberedId(ids[last + 1]))) ++last;
    ranges.push_back(ids[first]);
    if (last > first) ranges.back() += fmt::format("…{}", NumberedId(ids[last]).digits);
  }
  return ranges;
}

}  // namespace shelfbeam
