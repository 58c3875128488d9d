#include "shelfbeam/base/changed_ids.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

bool are_digits(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

// 4,00638E+12, and as Java writes it, 4.006381333931E12. Ids such as 3E12, 1.2E4 and 3E-12 may be those of a
// bay.
bool is_scientific(std::string_view id) {
  const std::size_t e = id.find_first_of("eE");
  if (e == std::string_view::npos) return false;
  const std::size_t mark = std::min(id.find_first_of(".,"), e);
  const std::string_view decimals = id.substr(std::min(mark + 1, e), e - std::min(mark + 1, e));
  std::string_view exponent = id.substr(e + 1);
  const char sign = exponent.empty() ? ' ' : exponent.front();
  if (sign == '+' || sign == '-') exponent.remove_prefix(1);
  if (!are_digits(id.substr(0, mark)) || !are_digits(exponent) || (mark < e && !are_digits(decimals)))
    return false;
  constexpr std::size_t least_decimals = 3;
  if (sign == '+' || sign == '-') return exponent.size() > 1 && (sign == '+' || mark < e);
  return mark == 1 && decimals.size() >= least_decimals;
}

// 4,006,381,333,931, which has more groups than the path of a shelf.
bool has_groups_of_thousands(std::string_view id) {
  const std::size_t head = std::min(id.find_first_not_of("0123456789"), id.size());
  if (head == 0 || head > 3) return false;
  for (const std::string_view mark : {".", " ", ",", "'", "\u2019", "\u00A0", "\u202F"}) {
    const std::size_t least = mark == "." || mark == " " ? 3 : 2, step = mark.size() + 3;
    std::string_view rest = id.substr(head);
    std::size_t groups = 0;
    for (; rest.starts_with(mark) && rest.size() >= step; ++groups) {
      if (!are_digits(rest.substr(mark.size(), 3))) break;
      rest.remove_prefix(step);
    }
    if (rest.empty() && groups >= least) return true;
  }
  return false;
}

// Spreadsheets keep 15 digits of a number, and write zeros for the others: 340123450000000000.
bool is_long(std::string_view id) {
  return id.size() > 16 && are_digits(id);
}
bool is_rounded(std::string_view id) {
  constexpr std::size_t kept = 15;
  return is_long(id) && id.find_first_not_of('0', kept) == std::string_view::npos;
}

// 2024-02-01, 1.2.2024, 01-Feb, 1. Feb, Feb-24, with or without a time.
bool is_date(std::string_view id) {
  constexpr std::string_view months =
      "Jan Feb Mar Mär Mrz Apr Avr May Mai Jun Jul Aug Aou Sep Sept Oct Okt Nov Dec Dez ";
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at < id.size() && parts.size() < 4;) {
    const std::size_t end = std::min(id.find_first_of("-./ T", id[at] == 'T' ? at + 1 : at), id.size());
    if (end > at) parts.push_back(id.substr(at, end - at));
    at = end + 1;
  }
  const auto is_month = [&](std::string_view part) {
    return part.size() >= 3 && months.find(std::string(part) + ' ') != std::string_view::npos;
  };
  const auto is_number = [](std::string_view part, std::size_t digits) {
    return are_digits(part) && part.size() <= digits;
  };
  const auto is_year = [](std::string_view part) {
    return are_digits(part) && part.size() == 4 && (part.starts_with("19") || part.starts_with("20"));
  };
  if (parts.size() < 2) return false;
  if (is_month(parts[0])) return is_number(parts[1], 2) || is_year(parts[1]);
  if (is_number(parts[0], 2) && is_month(parts[1])) return parts.size() == 2 || is_number(parts[2], 4);
  return parts.size() > 2 && is_number(parts[1], 2) &&
         ((is_year(parts[0]) && is_number(parts[2], 2)) || (is_number(parts[0], 2) && is_year(parts[2])));
}

bool is_missing_or_wrong(std::string_view id) {
  constexpr std::array<std::string_view, 14> known{"nan",  "-nan",   "<na>",          "nat",      "none",
                                                   "null", "(null)", "n/a",           "na",       "#n/a",
                                                   "#nv",  "#n/d",   "#getting_data", "undefined"};
  if (std::find(known.begin(), known.end(), lower_case(id)) != known.end()) return true;
  if (id.size() > 2 && id.find_first_not_of('#') == std::string_view::npos) return true;
  return (id.size() > 2 && id[0] == '#' && (id.back() == '!' || id.back() == '?')) ||
         (id.starts_with("Err:") && are_digits(id.substr(4)));
}

bool is_changed(std::string_view id) {
  // An apostrophe marks texts in spreadsheets.
  const bool is_marked = id.starts_with('\'') && are_digits(id.substr(1));
  return is_marked || id.starts_with('=') || is_missing_or_wrong(id) || is_scientific(id) ||
         has_groups_of_thousands(id) || is_date(id);
}

std::string lines_text(const std::vector<std::size_t>& lines, std::size_t count) {
  if (count == 1) return fmt::format("line {}", lines[0]);
  if (lines.size() < count)
    return fmt::format("lines {} and {} more", fmt::join(lines, ", "), grouped(count - lines.size()));
  return fmt::format("lines {} and {}", fmt::join(lines.begin(), lines.end() - 1, ", "), lines.back());
}

constexpr std::size_t most_shown = 5;
constexpr auto keep_as_text = "format the column as text before the file is saved";

}  // namespace

void ChangedIds::add(std::vector<Id>& ids, std::string_view id, std::size_t line) {
  auto found = std::find_if(ids.begin(), ids.end(), [&](const Id& other) { return other.id == id; });
  if (found == ids.end() && ids.size() > most_shown) found = ids.end() - 1;
  if (found == ids.end()) found = ids.insert(found, {ids.size() < most_shown ? std::string(id) : "", {}, 0});
  if (++found->count <= most_shown) found->lines.push_back(line);
}

// 12345678905 beside 012345678905.
void ChangedIds::note_zeros(std::string_view id, std::size_t line) {
  constexpr std::size_t least_digits = 7;  // shorter numbers may be those of shelves
  const std::size_t zeros = std::min(id.find_first_not_of('0'), id.size());
  if (id.size() - zeros < least_digits || !are_digits(id)) return;
  const std::string digits(id.substr(zeros));
  const auto [other, is_new] = zeros_.try_emplace(digits, zeros, line);
  if (is_new || other->second.first == zeros) return;
  const auto [other_zeros, other_line] = other->second;
  add(without_zeros_, std::string(std::min(zeros, other_zeros), '0') + digits,
      zeros < other_zeros ? line : other_line);
}

void ChangedIds::note(std::string_view id, std::size_t line) {
  const std::size_t mark = id.find_first_of(".,");
  const bool is_decimal =
      mark != std::string_view::npos && are_digits(id.substr(0, mark)) && are_digits(id.substr(mark + 1));
  const bool is_whole = is_decimal && id.find_first_not_of('0', mark + 1) == std::string_view::npos;
  has_fractions_ = has_fractions_ || (is_decimal && !is_whole);
  if (is_whole) add(whole_, id, line);
  has_long_ = has_long_ || (is_long(id) && !is_rounded(id));
  if (is_rounded(id)) add(rounded_, id, line);
  note_zeros(id, line);
  if (is_changed(id)) add(changed_, id, line);
}

std::optional<Finding> ChangedIds::warning(const std::string& file) const {
  std::vector<Id> ids = changed_;
  if (!has_fractions_) ids.insert(ids.end(), whole_.begin(), whole_.end());
  if (!has_long_) ids.insert(ids.end(), rounded_.begin(), rounded_.end());
  ids.insert(ids.end(), without_zeros_.begin(), without_zeros_.end());
  if (ids.empty()) return {};
  std::vector<std::string> shown;
  FindingValues values;
  for (const Id& id : ids) {
    shown.push_back(
        fmt::format("{} in {}", id.id.empty() ? "others" : in_quotes(id.id), lines_text(id.lines, id.count)));
    if (!id.id.empty()) values.emplace_back(id.id);
  }
  return Finding{FindingCode::changed_ids, file, std::move(values),
                 fmt::format("{}: has ids that look as if a spreadsheet has changed them: {}; {}", file,
                             fmt::join(shown, ", "), keep_as_text)};
}

std::string id_remedy(std::string_view id, std::string_view remedy) {
  if (!is_changed(id)) return std::string(remedy);
  return fmt::format("it looks as if a spreadsheet has changed it: {}", keep_as_text);
}

}  // namespace shelfbeam
