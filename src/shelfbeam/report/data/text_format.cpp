#include "shelfbeam/report/data/text_format.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/text/catalogue.hpp"

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

std::string fixed(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return value < 0 && !zero ? "−" + text : text;
}

std::string significant(double value, int digits) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "–";
  // Rounded first, so that 9.996 counts as 10.0 and not as 9.996 with two decimals.
  const double rounded = std::stod(fmt::format("{:.{}e}", value, digits - 1));
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-12));
  if (exponent < -4 || exponent > 6) {
    const std::string mantissa = fixed(rounded / std::pow(10, exponent), digits - 1);
    return fmt::format("{}·10^{}", mantissa, exponent);
  }
  return fixed(rounded, std::max(0, digits - 1 - exponent));
}

std::string decibels(double value, int decimals) {
  if (std::isinf(value)) return say(value < 0 ? "margin.no_signal" : "margin.no_requirement");
  // Two decimals for a small margin, which would otherwise read as 0.0 dB.
  const std::string text = fixed(value, std::abs(value) < 0.095 ? std::max(decimals, 2) : decimals);
  return (value > 0 && text != "0.00" ? "+" : "") + text + "\u00A0dB";
}

std::string percent(double share, int decimals) {
  return fixed(100 * share, decimals) + "\u00A0%";
}

double rounded_down(double value, int decimals) {
  constexpr double rounding = 1e-9;
  const double scale = std::pow(10, decimals);
  return std::floor(scale * value + rounding * std::max(1.0, std::abs(scale * value))) / scale;
}

double rounded_up(double value, int decimals) {
  return -rounded_down(-value, decimals);
}

std::string plain_down(double value) {
  constexpr int digits = 6;
  if (value == 0 || !std::isfinite(value)) return plain(value);
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return plain(rounded_down(value, digits - 1 - exponent));
}

std::string confidence_text(double confidence) {
  constexpr int decimals = 4;
  return plain(rounded_down(100 * confidence, decimals));
}

std::string with_joined_percent(std::string text) {
  for (std::size_t at = 0; (at = text.find(" %", at)) != std::string::npos;) text.replace(at, 2, "\u00A0%");
  return text;
}

std::string plain(double value) {
  const std::string text = fmt::format("{:.6g}", std::abs(value));
  return value < 0 && text != "0" ? "−" + text : text;
}

std::string csv_number(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

SignalUnit signal_unit(double reference) {
  constexpr std::array<std::pair<double, const char*>, 6> prefixes{
      {{1e3, "k"}, {1, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}}};
  for (const auto& [factor, prefix] : prefixes)
    if (reference >= factor) return {factor, std::string(prefix) + "W/m²"};
  return {};
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
