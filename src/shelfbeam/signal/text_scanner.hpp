#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace shelfbeam::detail {

enum class LineBreaks {
  matter,  ///< a number must stand on the line that is being read; `at_end` moves to the next line
  blank    ///< a line break is as good as a blank
};

/// Reads blank-separated numbers from a text; what does not fit throws InputError with file, line and place.
class TextScanner {
 public:
  /// `name` stands for the file in errors. The text must outlive the scanner.
  TextScanner(std::string_view text, std::string name, LineBreaks line_breaks);

  /// True when only blanks and line breaks are left; else stands before the next number.
  bool at_end();
  /// Throws unless the line ends here.
  void end_line(std::string_view what);

  /// The next whole number, within [low, high].
  std::uint32_t whole(std::string_view what, std::uint32_t low, std::uint32_t high);
  /// The next number; finite and not negative.
  double amount(std::string_view what);
  /// A count from a file's first line. Throws when it is 0 or so large that the text could not bear it, so
  /// that memory may be taken for it.
  std::uint32_t extent(std::string_view what);

  /// How many characters have been read.
  std::size_t position() const { return position_; }
  /// At the number that was read last.
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const;

 private:
  void skip_blanks();
  std::string_view token(std::string_view what);

  std::string_view text_;
  std::string name_;
  LineBreaks line_breaks_;
  std::size_t position_ = 0;
  std::size_t line_ = 1;
  std::size_t line_begin_ = 0;
  std::size_t token_ = 0;  ///< where the last token began, for errors
};

}  // namespace shelfbeam::detail
