#include "shelfbeam/base/csv.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

CsvReader::CsvReader(std::string_view text, std::string name) : text_(text), name_(std::move(name)) {}

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
  next_line_ += static_cast<std::size_t>(std::count(content.begin(), content.end(), '\n'));
  if (!escaped) return content;
  std::string& plain = unescaped_.emplace_back();
  for (std::size_t i = 0; i < content.size(); ++i) {
    plain += content[i];
    if (content[i] == '"') ++i;
  }
  return plain;
}

bool CsvReader::next() {
  do {
    if (position_ >= text_.size()) return false;
    line_ = next_line_;
    fields_.clear();
    unescaped_.clear();
    while (true) {
      const std::size_t content = text_.find_first_not_of(" \t", position_);
      if (content != std::string_view::npos && text_[content] == '"') {
        position_ = content;
        fields_.push_back(quoted_field());
        const std::size_t end = std::min(text_.find_first_of(",\n", position_), text_.size());
        if (!trim(text_.substr(position_, end - position_)).empty())
          fail(fields_.size() - 1, "continues after its closing quote", "double the quotes inside the field");
        position_ = end;
      } else {
        const std::size_t end = std::min(text_.find_first_of(",\n", position_), text_.size());
        fields_.push_back(trim(text_.substr(position_, end - position_)));
        position_ = end;
      }
      if (position_ >= text_.size()) break;
      if (text_[position_++] == '\n') {
        ++next_line_;
        break;
      }
    }
  } while (fields_.size() == 1 && fields_[0].empty());
  return true;
}

double CsvReader::number(std::size_t field) const {
  const auto value = to_number(fields_[field]);
  if (!value) {
    if (fields_[field].empty()) fail(field, "is empty", "a number is expected");
    fail(field, fmt::format("is '{}'", fields_[field].substr(0, 40)), "a number is expected");
  }
  if (!std::isfinite(*value))
    fail(field, std::string(amount_problem(std::abs(*value))), "a finite number is expected");
  return *value;
}

double CsvReader::amount(std::size_t field) const {
  const double value = number(field);
  if (value < 0) fail(field, "is negative", "a finite number that is not negative is expected");
  return value;
}

std::string CsvReader::id(std::size_t field) const {
  if (fields_[field].empty()) fail(field, "is empty", "an id is expected");
  return std::string(fields_[field]);
}

std::uint32_t CsvIdLookup::read(const CsvReader& csv, std::size_t field) const {
  const std::string id = csv.id(field);
  const auto found = index_.find(id);
  if (found != index_.end()) return found->second;
  const std::string near = nearest(id, known_);
  csv.fail(field, fmt::format("the matrix has no {} '{}'", kind_, id),
           near.empty() ? "correct the id or remove the line" : fmt::format("did you mean '{}'?", near));
}

std::string csv_field(std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos && trim(field) == field)
    return std::string(field);
  std::string quoted = "\"";
  for (const char c : field) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

}  // namespace shelfbeam
