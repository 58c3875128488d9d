#include "shelfbeam/signal/tables/csv_readings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string_view>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

namespace {

using Numbers = std::vector<double>;

std::optional<double> number_of(std::string field) {
  std::replace(field.begin(), field.end(), ',', '.');
  return to_number(field);
}

bool are_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool is_whole(double number) {
  return number == std::floor(number);
}

// The fields as whole numbers, such as "7", "7.0" and "4E+12"; empty if one is not.
Numbers whole_numbers(const std::vector<std::string>& fields) {
  Numbers numbers;
  for (const std::string& field : fields) {
    const auto number = number_of(field);
    if (!number || !is_whole(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

bool count_up(const Numbers& numbers) {
  constexpr std::size_t least = 3;
  const auto skips = [](double a, double b) { return b != a + 1; };
  return numbers.size() >= least &&
         std::adjacent_find(numbers.begin(), numbers.end(), skips) == numbers.end();
}

bool are_different(Numbers numbers) {
  std::sort(numbers.begin(), numbers.end());
  return std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end();
}

// The signals behind the first row, or behind the first column, of a matrix.
struct Rest {
  double largest = 0;
  bool has_fractions = false;

  Rest(const SignalTable& table, std::size_t first_row, std::size_t first_column) {
    for (std::size_t i = first_row; i < table.row_begin.size() - 1; ++i)
      for (std::size_t k = table.row_begin[i]; k < table.row_begin[i + 1]; ++k) {
        if (table.entries[k].transceiver < first_column) continue;
        const double signal = table.entries[k].signal;
        largest = std::max(largest, signal);
        has_fractions = has_fractions || !is_whole(signal);
      }
  }

  bool is_much_less_than(const Numbers& ids) const {
    constexpr double much = 10;
    return ids.size() > 1 && largest > 0 && *std::min_element(ids.begin(), ids.end()) > much * largest;
  }
};

// "T1" and "T2", "T9" and "T10", "unit a" and "unit b".
bool are_successive(std::string_view title, std::string_view next) {
  const auto [a, b] = std::mismatch(title.begin(), title.end(), next.begin(), next.end());
  title.remove_prefix(static_cast<std::size_t>(a - title.begin()));
  next.remove_prefix(static_cast<std::size_t>(b - next.begin()));
  const bool is_letter = title.size() == 1 && next.size() == 1 && next[0] == title[0] + 1;
  return is_letter || (are_digits(title) && are_digits(next));
}

}  // namespace

bool may_be_header(const std::vector<std::string>& row, const SignalTable& table) {
  const Numbers numbers = whole_numbers(row);
  if (numbers.empty()) return false;
  const bool are_plain = std::all_of(row.begin(), row.end(), are_digits);
  for (const std::ptrdiff_t first : {0, 1}) {
    const Numbers ids(numbers.begin() + first, numbers.end());
    if (count_up(ids)) return true;
    if (ids.empty() || !are_different(ids)) continue;
    const Rest rest(table, 1, static_cast<std::size_t>(first));
    if ((first == 0 && are_plain && rest.has_fractions) || rest.is_much_less_than(ids)) return true;
  }
  return false;
}

bool may_be_labels(const std::vector<std::string>& column, const SignalTable& table) {
  const Numbers ids = whole_numbers(column);
  const Rest rest(table, 0, 1);
  return (count_up(ids) && rest.has_fractions) || (are_different(ids) && rest.is_much_less_than(ids));
}

bool may_be_signals(const std::string& title, const SignalTable& table) {
  constexpr std::array<std::string_view, 22> titles{
      "",           "#",   "no",   "nr",       "number", "id",     "ids",      "index",
      "unnamed: 0", "row", "name", "position", "label",  "labels", "label_id", "esl",
      "ean",        "sku", "gtin", "article",  "tag",    "shelf"};
  if (std::find(titles.begin(), titles.end(), lower_case(title)) != titles.end()) return false;
  bool has_fractions = false, are_bits = true;
  for (const SignalTable::Label& label : table.labels) {
    const auto value = number_of(label.id);
    if (!value) return false;
    has_fractions = has_fractions || !is_whole(*value);
    are_bits = are_bits && (*value == 0 || *value == 1);
  }
  return has_fractions || are_bits || are_successive(title, table.transceivers.front().id);
}

}  // namespace shelfbeam::detail
