#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/device/direction_table.hpp"

namespace shelfbeam::detail {

/// The lines of a photometric file, read one after the other. Lines end with LF, CR LF or CR; a byte order
/// mark and a trailing control-Z are dropped, blanks around a line, too.
class PhotometricLines {
 public:
  /// Throws InputError for a text too long to be a photometric file.
  PhotometricLines(std::string_view text, std::string name);

  /// InputError at a line, counted from 1; 0 is the whole file.
  [[noreturn]] void fail(std::size_t line, const std::string& problem, const std::string& suggestion) const;

  /// The same at the line that `next` gave last.
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const {
    fail(line(), problem, suggestion);
  }
  /// A number of that line as a whole one. Throws InputError unless it is, within [low, high].
  std::size_t whole(double value, std::size_t low, std::size_t high, std::string_view what) const;

  /// The number of the line that `next` gave last.
  std::size_t line() const { return next_; }
  std::size_t remaining() const { return lines_.size() - next_; }
  std::size_t characters() const { return characters_; }  ///< in the whole file
  bool at_end() const { return next_ == lines_.size(); }
  /// Throws when there is none; `what` is what the caller hoped to find.
  std::string_view next(std::string_view what);

  /// Throws when there is more than blank lines and the word END, which some programs write.
  void expect_end();

  /// Throws unless the table can be scaled to a flux.
  DirectionTable checked(DirectionTable table) const;

 private:
  std::string name_;
  std::vector<std::string_view> lines_;
  std::size_t characters_;
  std::size_t next_ = 0;
};

/// The finite number that the whole word is; independent of the locale.
std::optional<double> finite_number(std::string_view word);

/// An angle in degrees, made exact where rounding left it within 0.001 of a multiple of 90.
double snapped(double angle);

/// A word of a file for an error message: shortened, without control characters.
std::string quoted(std::string_view word);

}  // namespace shelfbeam::detail
