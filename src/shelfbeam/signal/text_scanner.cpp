#include "shelfbeam/signal/text_scanner.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/number.hpp"

namespace shelfbeam::detail {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\f';
}

// A row or column that nothing refers to needs no character of the text, so small texts get some slack.
constexpr std::size_t slack = 1 << 16;

}  // namespace

TextScanner::TextScanner(std::string_view text, std::string name, LineBreaks line_breaks)
    : text_(text), name_(std::move(name)), line_breaks_(line_breaks) {}

void TextScanner::fail(const std::string& problem, const std::string& suggestion) const {
  throw InputError(fmt::format("{}: line {}, character {}", name_, line_, token_ - line_begin_ + 1), problem,
                   suggestion);
}

void TextScanner::skip_blanks() {
  while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
  token_ = position_;
}

bool TextScanner::at_end() {
  skip_blanks();
  while (position_ < text_.size() && text_[position_] == '\n') {
    line_begin_ = ++position_;
    ++line_;
    skip_blanks();
  }
  return position_ == text_.size();
}

void TextScanner::end_line(std::string_view what) {
  skip_blanks();
  if (position_ < text_.size() && text_[position_] != '\n')
    fail(fmt::format("the line goes on after {}", what), "remove the rest or correct the count");
}

std::string_view TextScanner::token(std::string_view what) {
  if (line_breaks_ == LineBreaks::blank)
    at_end();
  else
    skip_blanks();
  const std::size_t begin = position_;
  while (position_ < text_.size() && !is_blank(text_[position_]) && text_[position_] != '\n') ++position_;
  if (position_ == begin)
    fail(fmt::format("the {} ends where {} is expected", position_ == text_.size() ? "file" : "line", what),
         "check that the file is complete and its counts are right");
  return text_.substr(begin, position_ - begin);
}

std::uint32_t TextScanner::whole(std::string_view what, std::uint32_t low, std::uint32_t high) {
  const std::string_view word = token(what);
  std::int64_t value = 0;
  const char* end = word.data() + word.size();
  const auto [stopped, error] = std::from_chars(word.data(), end, value);
  if (stopped != end || error == std::errc::invalid_argument)
    fail(fmt::format("{} is '{}'", what, word.substr(0, 40)), "a whole number is expected");
  if (error != std::errc{} || value < low || value > high)
    fail(fmt::format("{} is {}", what, word.substr(0, 40)),
         fmt::format("a number from {} to {} is expected", low, high));
  return static_cast<std::uint32_t>(value);
}

double TextScanner::amount(std::string_view what) {
  const std::string_view word = token(what);
  const auto value = to_number(word);
  if (!value) fail(fmt::format("{} is '{}'", what, word.substr(0, 40)), "a number is expected");
  if (const auto problem = amount_problem(*value); !problem.empty())
    fail(fmt::format("{} {}", what, problem), "a finite number that is not negative is expected");
  return *value;
}

std::uint32_t TextScanner::extent(std::string_view what) {
  const std::uint32_t count = whole(what, 1, std::numeric_limits<std::uint32_t>::max() - 1);
  if (count > std::max(text_.size(), slack))
    fail(fmt::format("{} is {}, more than a file of {} characters can hold", what, count, text_.size()),
         "correct the count, or fetch the file again if it is truncated");
  return count;
}

}  // namespace shelfbeam::detail
