#include "serve/text/json_value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/json_parser.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::serve {

namespace {

// Compares two types of integers, which the library's operator converts to one.
bool same_number(const Json& a, const Json& b) {
  if (a.is_number_float() || b.is_number_float()) return a.get<double>() == b.get<double>();
  if (a.is_number_unsigned() == b.is_number_unsigned()) return a == b;
  const Json& natural = a.is_number_unsigned() ? a : b;
  const Json& integer = a.is_number_unsigned() ? b : a;
  return std::cmp_equal(natural.get<std::uint64_t>(), integer.get<std::int64_t>());
}

bool same_object(const Json& a, const Json& b) {
  if (a.size() != b.size()) return false;
  auto guess = b.begin();  // most objects have their keys in the same order
  for (auto member = a.begin(); member != a.end(); ++member) {
    const auto found = guess.key() == member.key() ? guess : b.find(member.key());
    if (found == b.end() || !same_value(*member, *found)) return false;
    guess = std::next(found) == b.end() ? b.begin() : std::next(found);
  }
  return true;
}

std::string float_text(double value) {
  if (value == 0) return "0";
  // Other numbers are easier to read as powers of ten.
  constexpr double smallest = 1e-6, largest = 1e15;
  const double magnitude = std::abs(value);
  const bool is_plain = magnitude >= smallest && magnitude < largest;
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), value,
                                 is_plain ? std::chars_format::fixed : std::chars_format::scientific)
                       .ptr;
  std::string text(digits, end);
  // "1e+20", "1e-07"
  if (const auto exponent = text.find('e'); exponent != std::string::npos) {
    const auto first = text.find_first_not_of("+-0", exponent + 1);
    text.replace(exponent + 1, first - exponent - 1, text[exponent + 1] == '-' ? "-" : "");
  }
  return text;
}

}  // namespace

bool same_value(const Json& a, const Json& b) {
  if (a.is_number() && b.is_number()) return same_number(a, b);
  if (a.is_object() && b.is_object()) return same_object(a, b);
  if (a.is_array() && b.is_array()) return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_value);
  return !a.is_structured() && a == b;
}

std::string value_problem(const Json& value, std::size_t level) {
  if (value.is_string() && !is_utf8(value.get_ref<const std::string&>()))
    return "has a text that is not UTF-8";
  if (value.is_number_float() && !std::isfinite(value.get<double>()))
    return "has a number that is not finite";
  if (value.is_binary() || value.is_discarded()) return "is not JSON";
  if (!value.is_structured()) return {};
  if (level >= max_json_levels) return fmt::format("has more than {} nested brackets", max_json_levels);
  for (auto part = value.begin(); part != value.end(); ++part) {
    if (value.is_object() && !is_utf8(part.key())) return "has a key that is not UTF-8";
    if (std::string problem = value_problem(*part, level + 1); !problem.empty()) return problem;
  }
  return {};
}

std::string scalar_text(const Json& value) {
  return value.is_number_float() ? float_text(value.get<double>()) : value.dump();
}

}  // namespace shelfbeam::serve
