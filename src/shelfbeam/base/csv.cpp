#include "shelfbeam/base/csv.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

constexpr std::string_view all_separators = ",;\t";

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

std::string_view first_line(std::string_view text) {
  return text.substr(0, text.find_first_of("\r\n"));
}

// The character after "sep=" if this is the whole line, as Excel reads and writes it.
std::optional<char> stated_separator(std::string_view text) {
  std::string_view line = first_line(text);
  if (line.size() > 2 && line.front() == '"' && line.back() == '"') line = line.substr(1, line.size() - 2);
  if (line.size() != 5 || lower_case(line.substr(0, 4)) != "sep=") return std::nullopt;
  return line.back();
}

// Whether the text is a formula for a spreadsheet, possibly behind apostrophes.
bool is_formula(std::string_view text) {
  const std::size_t first = text.find_first_not_of('\'');
  return first != std::string_view::npos &&
         std::string_view("=+-@\t\r").find(text[first]) != std::string_view::npos;
}

}  // namespace

std::string csv_separators(std::string_view text) {
  if (const auto stated = stated_separator(text)) return {*stated};
  std::string found;
  bool is_quoted = false, has_content = false;
  char before = ' ';  // the last character that is not a blank
  const auto is_other = [](char c) { return c == ',' || c == ';' || ends_line(c); };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') is_quoted = !is_quoted;
    if (!is_quoted && ends_line(c)) {
      if (has_content) break;
      before = ' ';
      continue;
    }
    if (!is_quoted && (c == ' ' || c == '\t')) {
      // Tabs beside other separators are blanks.
      const std::size_t next = std::min(text.find_first_not_of(" \t", i), text.size());
      const bool has_tab = text.substr(i, next - i).find('\t') != std::string_view::npos;
      const bool is_beside = is_other(before) || next == text.size() || is_other(text[next]);
      if (has_tab && !is_beside && found.find('\t') == std::string::npos) found += '\t';
      i = next - 1;
      continue;
    }
    has_content = true;
    if (!is_quoted && (c == ',' || c == ';') && found.find(c) == std::string::npos) found += c;
    before = c;
  }
  return found;
}

CsvReader::CsvReader(std::string_view text, std::string name, std::optional<char> separator)
    : text_(without_mark(text, name, save_table_as_utf8)), name_(std::move(name)) {
  if (!is_utf8(text_)) throw InputError(name_, "is not UTF-8", save_table_as_utf8);
  const std::string separators = csv_separators(text_);
  separator_ = separator.value_or(separators.empty() ? ',' : separators.front());
  if (!stated_separator(text_)) return;
  line_ = 1;
  if (all_separators.find(separators.front()) == std::string_view::npos)
    fail(fmt::format("names the unknown separator '{}'", separators), "use a comma, a semicolon or a tab");
  position_ = first_line(text_).size();
  end_line();
}

std::string CsvReader::where() const {
  return fmt::format("{}: line {}", name_, line_);
}

void CsvReader::fail(const std::string& problem, const std::string& suggestion) const {
  throw InputError(where(), problem, suggestion);
}

void CsvReader::fail(std::size_t field, const std::string& problem, const std::string& suggestion) const {
  throw InputError(fmt::format("{}, field {}", where(), field + 1), problem, suggestion);
}

std::string_view CsvReader::quoted_field() {
  const std::size_t begin = ++position_;
  bool escaped = false;
  while (true) {
    position_ = text_.find('"', position_);
    if (position_ == std::string_view::npos)
      fail(fields_.size(), "has an unclosed quote", "close it with '\"'");
    if (position_ + 1 >= text_.size() || text_[position_ + 1] != '"') break;
    escaped = true;
    position_ += 2;
  }
  std::string_view content = text_.substr(begin, position_ - begin);
  ++position_;
  for (std::size_t i = 0; i < content.size(); ++i)
    if (content[i] == '\n' || (content[i] == '\r' && !content.substr(i + 1).starts_with('\n'))) ++next_line_;
  if (!escaped) return content;
  std::string& plain = unescaped_.emplace_back();
  for (std::size_t i = 0; i < content.size(); ++i) {
    plain += content[i];
    if (content[i] == '"') ++i;
  }
  return plain;
}

// Moves behind a line end, if there is one here.
void CsvReader::end_line() {
  if (position_ >= text_.size()) return;
  position_ += text_.substr(position_).starts_with("\r\n") ? 2 : 1;
  ++next_line_;
}

bool CsvReader::next() {
  const std::string_view blanks = separator_ == '\t' ? " " : " \t";
  do {
    if (position_ >= text_.size()) {
      // Whole lengths beside 1.250 show that the file does not write decimals to all numbers.
      const bool is_shown =
          decimal_.line != 0 || (!is_doubtful_ && !(has_unclear_length_ && has_whole_length_));
      if (unclear_.line == 0 || is_shown) return false;
      line_ = unclear_.line;
      std::string whole = unclear_.number;
      std::erase(whole, unclear_.mark);
      fail(unclear_.field,
           fmt::format("is '{}', which may have a thousands separator; no other number of the file decides",
                       unclear_.number),
           fmt::format("write '{}' or '{}0'", whole, unclear_.number));
    }
    line_ = next_line_;
    fields_.clear();
    unescaped_.clear();
    while (true) {
      const std::size_t content = text_.find_first_not_of(blanks, position_);
      const bool is_quoted = content != std::string_view::npos && text_[content] == '"';
      if (is_quoted) {
        position_ = content;
        fields_.push_back(quoted_field());
      }
      const std::size_t begin = position_;
      while (position_ < text_.size() && text_[position_] != separator_ && !ends_line(text_[position_]))
        ++position_;
      const std::string_view rest = trim(text_.substr(begin, position_ - begin));
      if (!is_quoted)
        fields_.push_back(rest);
      else if (!rest.empty())
        fail(fields_.size() - 1, "continues after its closing quote", "double the quotes inside the field");
      if (position_ >= text_.size()) break;
      if (ends_line(text_[position_])) {
        end_line();
        break;
      }
      ++position_;
    }
  } while (std::all_of(fields_.begin(), fields_.end(), [](std::string_view field) { return field.empty(); }));
  repeat_merged();
  return true;
}

void CsvReader::fill_down(const std::vector<std::size_t>& columns) {
  merged_.clear();
  for (const std::size_t column : columns) merged_.emplace_back(column, "");
}

void CsvReader::repeat_merged() {
  for (auto one = merged_.begin(); one != merged_.end(); ++one) {
    auto& [column, above] = *one;
    if (column >= fields_.size()) continue;
    std::string_view& field = fields_[column];
    if (field.empty()) {
      field = above;
    } else if (field != above) {
      above = field;
      for (auto part = one + 1; part != merged_.end(); ++part) part->second.clear();
    }
  }
}

void CsvReader::expect_fields(std::size_t least, std::size_t most, std::string_view meaning) const {
  std::size_t count = fields_.size();
  while (count > most && fields_[count - 1].empty()) --count;
  if (count >= least && count <= most) return;
  fail("has " + counted(count, "field"),
       fmt::format("{} are expected{}{}", count < least ? least : most, meaning,
                   count > most && separator_ == ','
                       ? "; numbers with decimal commas need quotes, or semicolons between the fields"
                       : ""));
}

bool CsvReader::is_number(std::size_t field) const {
  if (to_number(fields_[field])) return true;
  // 1/2 and 3 250 may be ids of a bay and a shelf.
  const auto number = written_number(fields_[field]);
  return number && !number->unit && fields_[field].find_first_of("/ '") == std::string_view::npos;
}

void CsvReader::note_mark(std::size_t field, const WrittenNumber& number) {
  const char mark = number.mark;
  for (const Example& other : {decimal_, unclear_})
    if (other.line != 0 && other.mark != mark)
      fail(field,
           fmt::format("is {}, but line {} has {}", in_quotes(fields_[field]), other.line,
                       in_quotes(other.number)),
           "use the same decimal mark in the whole file");
  // Programs that separate by commas write decimal points, spreadsheets that separate by semicolons commas.
  const bool is_usual = (separator_ == ',' && mark == '.') || (separator_ == ';' && mark == ',');
  Example& example = number.grouped ? unclear_ : decimal_;
  if (number.grouped && !is_usual) is_doubtful_ = true;
  if (example.line != 0) return;
  const std::string_view digits = fields_[field].substr(0, fields_[field].find_last_of("0123456789") + 1);
  example = {line_, field, std::string(digits), mark};
}

WrittenNumber CsvReader::quantity(std::size_t field, std::optional<LengthUnit> unit, double most) {
  const std::string_view content = fields_[field];
  WrittenNumber number;
  // Most numbers of matrices need no closer look.
  const auto plain = to_number(content);
  if (plain &&
      (!std::isfinite(*plain) || decimal_.mark == '.' || content.find('.') == std::string_view::npos)) {
    number.value = *plain;
  } else if (auto written = written_number(content);
             written && (unit || content.find('/') == std::string_view::npos)) {
    number = *written;
    if (number.mark != 0) note_mark(field, number);
    if (unit && number.grouped) has_unclear_length_ = true;
  } else {
    if (content.empty()) fail(field, "is empty", "a number is expected");
    const bool is_grouped = content.find_first_not_of("0123456789., '", 1) == std::string_view::npos &&
                            content.find_first_of("0123456789") != std::string_view::npos;
    fail(field, fmt::format("is {}", in_quotes(content)),
         is_grouped ? "a number without thousands separators is expected" : "a number is expected");
  }
  if (number.unit && !unit)
    fail(field, fmt::format("is {}", in_quotes(content)), "a number without a unit is expected");
  if (!(std::abs(number.value) <= most))
    fail(field,
         number.value < -max_amount && std::isfinite(number.value)
             ? "is less than -1e18"
             : std::string(amount_problem(std::abs(number.value))),
         "a finite number is expected");
  if (unit && number.mark == 0 && number.value != 0) has_whole_length_ = true;
  if (!number.unit) number.unit = unit;
  return number;
}

CsvReader::Length CsvReader::length(std::size_t field, LengthUnit unit) {
  const WrittenNumber number = quantity(field, unit);
  return {number.value, *number.unit};
}

double CsvReader::amount(std::size_t field) {
  const double value = number(field);
  if (value < 0) fail(field, "is negative", "a finite number that is not negative is expected");
  return value;
}

std::string CsvReader::text(std::size_t field) const {
  std::string_view text = fields_[field];
  if (text.starts_with('\'') && is_formula(text)) text.remove_prefix(1);
  return std::string(text);
}

std::string CsvReader::id(std::size_t field) {
  std::string id = text(field);
  if (id.empty()) fail(field, "is empty", "an id is expected");
  if (const std::string character = unprintable_character(id); !character.empty())
    fail(field, fmt::format("has the unprintable character '{}'", character), "remove it from the id");
  ids_.note(id, line_);
  return id;
}

std::vector<std::string> CsvReader::column_names() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < fields_.size(); ++k) names.push_back(lower_case(text(k)));
  return names;
}

std::uint32_t CsvIdLookup::read(CsvReader& csv, std::size_t field) const {
  const std::string id = csv.id(field);
  const auto found = index_.find(id);
  if (found != index_.end()) return found->second;
  const std::string near = nearest(id, known_);
  csv.fail(field, fmt::format("the matrix has no {} {}", kind_, in_quotes(id)),
           id_remedy(id, near.empty() ? "correct the id or remove the line"
                                      : fmt::format("did you mean {}?", in_quotes(near))));
}

bool CsvIdLookup::is_ignored(CsvReader& csv, std::size_t field) const {
  return !ignored_.empty() && ignored_.contains(csv.id(field));
}

std::string csv_quoted(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

std::string csv_field(std::string_view text, bool safe) {
  std::string field(text);
  if (is_formula(text) && (safe || text.starts_with('\''))) field.insert(0, 1, '\'');
  const bool is_plain = field.find_first_of(",\"\r\n") == std::string::npos && trim(field) == field;
  return is_plain ? field : csv_quoted(field);
}

}  // namespace shelfbeam
