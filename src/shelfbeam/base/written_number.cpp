#include "shelfbeam/base/written_number.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

constexpr std::string_view decimal_digits = "0123456789";

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// Signs, marks and blanks of typography as those of a keyboard, in lower case.
std::string with_plain_signs(std::string_view text) {
  constexpr auto plain = std::to_array<std::pair<std::string_view, std::string_view>>({{"\u2212", "-"},
                                                                                       {"\u2032", "'"},
                                                                                       {"\u2019", "'"},
                                                                                       {"\u2033", "\""},
                                                                                       {"\u201c", "\""},
                                                                                       {"\u201d", "\""},
                                                                                       {"''", "\""},
                                                                                       {"\u00a0", " "},
                                                                                       {"\u2009", " "},
                                                                                       {"\u202f", " "}});
  std::string result;
  while (!text.empty()) {
    const auto found =
        std::ranges::find_if(plain, [&](const auto& one) { return text.starts_with(one.first); });
    result += found == plain.end() ? text.substr(0, 1) : found->second;
    text.remove_prefix(found == plain.end() ? 1 : found->first.size());
  }
  return lower_case(trim(result));
}

// Longer names come before those that they begin with.
constexpr auto unit_names =
    std::to_array<std::pair<std::string_view, LengthUnit>>({{"mm", LengthUnit::mm},
                                                            {"cm", LengthUnit::cm},
                                                            {"m", LengthUnit::m},
                                                            {"feet", LengthUnit::ft},
                                                            {"foot", LengthUnit::ft},
                                                            {"ft.", LengthUnit::ft},
                                                            {"ft", LengthUnit::ft},
                                                            {"'", LengthUnit::ft},
                                                            {"inches", LengthUnit::in},
                                                            {"inch", LengthUnit::in},
                                                            {"in.", LengthUnit::in},
                                                            {"in", LengthUnit::in},
                                                            {"\"", LengthUnit::in}});

class Reader {
 public:
  explicit Reader(std::string_view text) : rest_(text) {}

  std::optional<WrittenNumber> read() {
    const bool is_negative = rest_.starts_with('-');
    if (is_negative || rest_.starts_with('+')) rest_.remove_prefix(1);
    auto result = part();
    if (result && result->unit == LengthUnit::ft && !rest_.empty()) result = with_inches(*result);
    if (!result || !rest_.empty()) return {};
    if (!is_negative) return result;
    result->value = -result->value;
    if (result->grouped) result->grouped = -*result->grouped;
    return result;
  }

 private:
  // 12'-6", 12' 6 1/2", 12 ft 6 in: the dash has no blanks around it, or it may be a minus.
  std::optional<WrittenNumber> with_inches(const WrittenNumber& feet) {
    skip(rest_.starts_with('-') ? "-" : " ");
    const auto inches = part();
    const bool is_whole = feet.mark == 0 && !feet.grouped;
    if (!inches || inches->grouped || inches->unit != LengthUnit::in || !is_whole || inches->value >= 12)
      return {};
    return WrittenNumber{12 * feet.value + inches->value, {}, inches->unit, inches->mark};
  }

  // A number with its unit, if it has one.
  std::optional<WrittenNumber> part() {
    const std::string_view begin = rest_;
    auto number = decimals();
    if (!number) return {};
    const auto share = fraction(begin);
    if (share) {
      if (number->grouped || number->mark != 0) return {};
      number->value = *share;
    }
    const std::string_view behind = rest_;
    skip(" ");
    for (const auto& [name, unit] : unit_names) {
      if (!rest_.starts_with(name)) continue;
      const std::string_view after = rest_.substr(name.size());
      const bool is_word = name.back() >= 'a' && name.back() <= 'z';
      if (is_word && !after.empty() && after.front() >= 'a' && after.front() <= 'z') continue;
      number->unit = unit;
      rest_ = after;
      const bool is_imperial = unit == LengthUnit::ft || unit == LengthUnit::in;
      // 1'250" is not a number of thousands, and 1/2 m may be a division.
      const bool has_apostrophe =
          begin.substr(0, begin.size() - behind.size()).find('\'') != std::string_view::npos;
      if (is_imperial ? has_apostrophe : share.has_value()) return {};
      if (is_imperial && number->mark == '.') number->grouped.reset();
      return number;
    }
    rest_ = behind;
    return number;
  }

  // "1/2" at `begin`, or " 1/2" behind a whole number there; the rest moves behind it.
  std::optional<double> fraction(std::string_view begin) {
    const std::string_view first = begin.substr(0, begin.size() - rest_.size());
    double whole = 0;
    std::string_view above = first, text = rest_;
    if (text.starts_with(' ')) {
      text.remove_prefix(1);
      const std::size_t length = std::min(text.find_first_not_of(decimal_digits), text.size());
      above = text.substr(0, length);
      text.remove_prefix(length);
      whole = to_number(first).value_or(-1);
    }
    if (!text.starts_with('/') || first.find_first_not_of(decimal_digits) != std::string_view::npos)
      return {};
    text.remove_prefix(1);
    const std::size_t length = std::min(text.find_first_not_of(decimal_digits), text.size());
    const auto numerator = to_whole_number(above, 999),
               denominator = to_whole_number(text.substr(0, length), 999);
    if (!numerator || !denominator || whole < 0 || *numerator >= *denominator) return {};
    rest_ = text.substr(length);
    return whole + static_cast<double>(*numerator) / static_cast<double>(*denominator);
  }

  // Digits with marks, and an exponent.
  std::optional<WrittenNumber> decimals() {
    std::string joined;  // without blanks and apostrophes between thousands
    bool has_blanks = false;
    std::size_t at = 0;
    const auto three_at = [&](std::size_t from) {
      const std::size_t end = std::min(rest_.find_first_not_of(decimal_digits, from), rest_.size());
      return end == from + 3 && rest_.substr(end, 1) != "/";
    };
    for (; at < rest_.size(); ++at) {
      const char c = rest_[at];
      if (is_digit(c) || c == '.' || c == ',') {
        joined += c;
        continue;
      }
      const bool may_group = (c == ' ' || c == '\'') && !joined.empty() && joined.front() != '0' &&
                             (has_blanks || joined.size() <= 3) &&
                             joined.find_first_of(".,") == std::string::npos && three_at(at + 1);
      if (!may_group) break;
      has_blanks = true;
    }
    const std::size_t first = joined.find_first_of(".,");
    if (joined.empty() || joined.find_first_of(decimal_digits) == std::string::npos) return {};
    WrittenNumber number;
    if (first != std::string::npos) {
      const std::size_t last = joined.find_last_of(".,");
      const char before = joined[first], mark = joined[last];
      const bool is_single = first == last;
      const std::string_view behind = std::string_view(joined).substr(last + 1);
      if (!is_single) {
        // Several marks of one kind separate thousands; of two kinds, the last one is the decimal mark.
        const bool is_whole = before == mark;
        if (has_blanks ||
            !has_thousands(std::string_view(joined).substr(0, is_whole ? joined.size() : last), before))
          return {};
        number.mark = is_whole ? (mark == '.' ? ',' : '.') : mark;
        std::erase(joined, before);
      } else {
        number.mark = mark;
        if (!has_blanks && first >= 1 && first <= 3 && joined.front() != '0' && behind.size() == 3) {
          std::string whole = joined;
          whole.erase(first, 1);
          number.grouped = to_number(whole);
        }
      }
      std::ranges::replace(joined, ',', '.');
    }
    rest_.remove_prefix(at);
    if (rest_.starts_with('e') && !has_blanks) {
      const std::size_t sign = rest_.size() > 1 && (rest_[1] == '-' || rest_[1] == '+') ? 2 : 1;
      const std::size_t end = std::min(rest_.find_first_not_of(decimal_digits, sign), rest_.size());
      if (end == sign) return {};
      joined += rest_.substr(0, end);
      rest_.remove_prefix(end);
      number.grouped.reset();
    }
    // from_chars wants a digit before the point.
    if (joined.starts_with('.')) joined.insert(0, 1, '0');
    const auto value = to_number(joined);
    if (!value) return {};
    number.value = *value;
    return number;
  }

  // Whether the text is 1 to 3 digits, then groups of a mark and 3 digits.
  static bool has_thousands(std::string_view text, char mark) {
    std::size_t length = text.find(mark);
    if (length < 1 || length > 3) return false;
    for (std::size_t at = length; at < text.size(); at += 4)
      if (text[at] != mark || text.size() < at + 4 || !std::ranges::all_of(text.substr(at + 1, 3), is_digit))
        return false;
    return true;
  }

  void skip(std::string_view one) {
    if (rest_.starts_with(one)) rest_.remove_prefix(one.size());
  }

  std::string_view rest_;
};

}  // namespace

std::optional<WrittenNumber> written_number(std::string_view text) {
  return Reader(with_plain_signs(text)).read();
}

}  // namespace shelfbeam
