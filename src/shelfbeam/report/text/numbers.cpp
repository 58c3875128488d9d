#include "shelfbeam/report/text/numbers.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace shelfbeam {

std::string fixed_number(double value, int decimals) {
  std::string text = fmt::format("{:.{}f}", std::abs(value), decimals);
  const bool zero = text.find_first_not_of("0.") == std::string::npos;
  return value < 0 && !zero ? "−" + text : text;
}

std::string significant_number(double value, int digits) {
  if (value == 0) return "0";
  if (!std::isfinite(value)) return value > 0 ? "∞" : value < 0 ? "−∞" : "–";
  // Rounded first, so that 9.996 counts as 10.0 and not as 9.996 with two decimals.
  const double rounded = std::stod(fmt::format("{:.{}e}", value, digits - 1));
  const int exponent = static_cast<int>(std::floor(std::log10(std::abs(rounded)) + 1e-12));
  if (exponent < -4 || exponent > 6)
    return fmt::format("{}·10^{}", fixed_number(rounded / std::pow(10, exponent), digits - 1), exponent);
  return fixed_number(rounded, std::max(0, digits - 1 - exponent));
}

std::string plain_number(double value, int digits) {
  const std::string text = fmt::format("{:.{}g}", std::abs(value), digits);
  return value < 0 && text != "0" ? "−" + text : text;
}

double rounded_down(double value, int decimals) {
  constexpr double rounding = 1e-9;
  const double scale = std::pow(10, decimals);
  return std::floor(scale * value + rounding * std::max(1.0, std::abs(scale * value))) / scale;
}

double rounded_up(double value, int decimals) {
  return -rounded_down(-value, decimals);
}

}  // namespace shelfbeam
