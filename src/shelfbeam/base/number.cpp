#include "shelfbeam/base/number.hpp"

#include <charconv>
#include <cmath>
#include <system_error>

namespace shelfbeam {

std::optional<double> to_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);  // from_chars knows no '+'
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stopped != end) return std::nullopt;
  return value;
}

std::string_view amount_problem(double value) {
  if (std::isnan(value)) return "is NaN";
  if (std::isinf(value)) return "is infinite";
  if (value < 0) return "is negative";
  return {};
}

}  // namespace shelfbeam
