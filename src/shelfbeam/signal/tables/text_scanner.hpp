#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

namespace shelfbeam::detail {

inline bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\f';
}

inline bool ends_line(char c) {
  return c == '\n' || c == '\r';
}

enum class LineBreaks {
  matter,  ///< numbers must be on the current line; `at_end` moves to the next line
  blank    ///< a line break is equivalent to a blank
};

/// Reads blank-separated numbers from a text, whose lines end with LF, CR LF or CR. Other content throws
/// InputError with file, line and character.
class TextScanner {
 public:
  /// Errors name the file as `name`. The text must outlive the scanner.
  TextScanner(std::string_view text, std::string name, LineBreaks line_breaks)
      : text_(text), name_(std::move(name)), line_breaks_(line_breaks) {}

  /// Skips blanks and line breaks; true at the end of the text.
  bool at_end() {
    skip_blanks();
    while (position_ < text_.size() && ends_line(text_[position_])) {
      position_ += text_.substr(position_).starts_with("\r\n") ? 2 : 1;
      line_begin_ = position_;
      ++line_;
      skip_blanks();
    }
    return position_ == text_.size();
  }
  /// Throws unless the line ends here.
  void end_line(std::string_view what) {
    skip_blanks();
    if (position_ < text_.size() && !ends_line(text_[position_]))
      fail(fmt::format("the line continues after {}", what), "remove the rest or correct the count");
  }

  /// The next number, which must be an integer in [low, high].
  std::uint32_t integer(std::string_view what, std::uint32_t low, std::uint32_t high) {
    const std::string_view word = token(what);
    std::int64_t value = 0;
    const char* end = word.data() + word.size();
    const auto [stopped, error] = std::from_chars(word.data(), end, value);
    if (stopped != end || error == std::errc::invalid_argument)
      fail(fmt::format("{} is {}", what, in_quotes(word)), "a whole number is expected");
    if (error != std::errc{} || value < low || value > high)
      fail(fmt::format("{} is {}", what, shortened(word, 40)),
           fmt::format("a number from {} to {} is expected", low, high));
    return static_cast<std::uint32_t>(value);
  }
  /// The next number, which must be finite and not negative.
  double amount(std::string_view what) {
    const std::string_view word = token(what);
    const auto value = to_number(word);
    if (!value) fail(fmt::format("{} is {}", what, in_quotes(word)), "a number is expected");
    if (const auto problem = amount_problem(*value); !problem.empty())
      fail(fmt::format("{} {}", what, problem), "a finite number that is not negative is expected");
    return *value;
  }
  /// A count from a file's first line. Throws if it is 0 or too large for the length of the text, so that the
  /// caller can safely allocate memory for it.
  std::uint32_t extent(std::string_view what) {
    // Empty rows or columns need no characters, so small texts have some slack.
    constexpr std::size_t slack = 1 << 16;
    const std::uint32_t count = integer(what, 1, std::numeric_limits<std::uint32_t>::max() - 1);
    if (count > std::max(text_.size(), slack))
      fail(fmt::format("{} is {}, more than a file of {} characters can contain", what, count, text_.size()),
           "correct the count, or download the file again if it is truncated");
    return count;
  }

  /// Number of characters read so far.
  std::size_t position() const { return position_; }
  /// Throws InputError at the number that was read last.
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const {
    throw InputError(fmt::format("{}: line {}, character {}", name_, line_, token_ - line_begin_ + 1),
                     problem, suggestion);
  }

 private:
  void skip_blanks() {
    while (position_ < text_.size() && is_blank(text_[position_])) ++position_;
    token_ = position_;
  }
  std::string_view token(std::string_view what) {
    if (line_breaks_ == LineBreaks::blank)
      at_end();
    else
      skip_blanks();
    const std::size_t begin = position_;
    while (position_ < text_.size() && !is_blank(text_[position_]) && !ends_line(text_[position_]))
      ++position_;
    if (position_ == begin)
      fail(fmt::format("the {} ends where {} is expected", position_ == text_.size() ? "file" : "line", what),
           "check that the file is complete and its counts are right");
    return text_.substr(begin, position_ - begin);
  }

  std::string_view text_;
  std::string name_;
  LineBreaks line_breaks_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t line_begin_ = 0;
  std::size_t token_ = 0;  ///< beginning of the last token, for errors
};

}  // namespace shelfbeam::detail
