#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam::detail {

/// Reads the lines of a photometric file in order. Lines end with LF, CR LF or CR. A byte order mark, a
/// trailing control-Z and blanks around a line are removed.
class PhotometricLines {
 public:
  /// Throws InputError for a text too long to be a photometric file.
  PhotometricLines(std::string_view text, std::string name);

  /// Throws InputError at a line, counted from 1; 0 is the whole file.
  [[noreturn]] void fail(std::size_t line, const std::string& problem, const std::string& suggestion) const;

  /// Throws InputError at the line that `next` returned last.
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const {
    fail(line(), problem, suggestion);
  }
  /// `value` as an integer. Throws InputError at the last line unless it is an integer in [low, high].
  std::size_t whole(double value, std::size_t low, std::size_t high, std::string_view what) const;

  /// The number of the line that `next` returned last.
  std::size_t line() const { return next_; }
  std::size_t remaining() const { return lines_.size() - next_; }
  /// The number of remaining lines without those that `expect_end` ignores.
  std::size_t remaining_values() const;
  std::size_t characters() const { return characters_; }  ///< in the whole file
  bool at_end() const { return next_ == lines_.size(); }
  /// The next line. Throws at the end of the file; `what` names the expected content in the message.
  std::string_view next(std::string_view what);

  /// Throws unless only blank lines and the word END follow, which some programs write; `rest` is the part of
  /// the current line that has not been read.
  void expect_end(std::string_view rest = {});

  /// An intensity of the file times the factors of its head. Throws if it is negative or too large.
  double intensity(double value, double factor) const;

  /// Throws unless the table can be scaled to a flux.
  DirectionTable checked(DirectionTable table) const;

 private:
  std::string name_;
  std::vector<std::string_view> lines_;
  std::size_t characters_;
  std::size_t next_ = 0;
};

/// The whole word as a finite number; nothing if it is not one. Independent of the locale.
std::optional<double> finite_number(std::string_view word);

/// An angle in degrees, rounded to a multiple of 90 if it lies within 0.001 of it.
double snapped(double angle);

}  // namespace shelfbeam::detail
