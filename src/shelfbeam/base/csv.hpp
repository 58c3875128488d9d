#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "shelfbeam/base/changed_ids.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/base/written_number.hpp"

namespace shelfbeam {

/// Reads records (RFC 4180: fields may be quoted, and a quote inside them is doubled) as spreadsheets write
/// them. Fields are separated by commas, semicolons or tabs; in the first line either `sep=;` or the first
/// separator decides. Numbers are WrittenNumbers with decimal points or with decimal commas, the same in the
/// whole file. Lines end with LF, CR LF or CR. Blanks around unquoted fields and records of empty fields are
/// ignored. There is no comment syntax.
class CsvReader {
 public:
  /// Errors name the file as `name`. The text must outlive the reader. `separator` overrides the header's.
  /// Throws InputError for a text that is not UTF-8 and for an unknown separator after `sep=`.
  CsvReader(std::string_view text, std::string name, std::optional<char> separator = {});

  /// Moves to the next record; false at the end. Throws InputError at the end if no number has shown whether
  /// "1.500" is a decimal or has a thousands separator.
  bool next();
  /// From the next record on, empty fields of these columns repeat those of the record above, as merged cells
  /// of spreadsheets mean them. Each column is a part of those before it: a new value ends its repetition.
  void fill_down(const std::vector<std::size_t>& columns);
  /// The current record; valid until `next`.
  const std::vector<std::string_view>& fields() const { return fields_; }
  /// Throws InputError unless the record has `least` to `most` fields; further empty fields do not count.
  /// `meaning` completes "3 are expected".
  void expect_fields(std::size_t least, std::size_t most, std::string_view meaning = {}) const;

  bool is_number(std::size_t field) const;
  /// The field as a number; throws InputError unless its magnitude is at most `max_amount`.
  double number(std::size_t field) { return quantity(field, {}).value; }
  /// The same for any finite number, such as those of a direction.
  double finite_number(std::size_t field) {
    return quantity(field, {}, std::numeric_limits<double>::max()).value;
  }
  struct Length {
    double value;
    LengthUnit unit;
  };
  /// The field as a length, in its own unit if it names one, and otherwise in `unit`; as `number`.
  Length length(std::size_t field, LengthUnit unit);
  /// The field as a number; throws InputError unless it is finite and not negative.
  double amount(std::size_t field);
  /// The field as text: the text that `csv_field` was given.
  std::string text(std::size_t field) const;
  /// The field as an id; throws InputError when it is empty or has an unprintable character.
  std::string id(std::size_t field);
  /// The warning about the ids so far (ChangedIds), if any.
  std::optional<Finding> warning_of_ids() const { return ids_.warning(name_); }
  /// The fields in lower case, so that columns are found by their names in any spelling.
  std::vector<std::string> column_names() const;

  /// "file: line 3" for errors.
  std::string where() const;
  /// Throws InputError with the file, the line and, if given, the field (index from 0).
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const;
  [[noreturn]] void fail(std::size_t field, const std::string& problem, const std::string& suggestion) const;

 private:
  /// The first number of a kind.
  struct Example {
    std::size_t line = 0, field = 0;  ///< line 0: there is none
    std::string number;
    char mark = 0;  ///< its decimal mark
  };

  std::string_view quoted_field();
  void end_line();
  void repeat_merged();
  WrittenNumber quantity(std::size_t field, std::optional<LengthUnit> unit, double most = max_amount);
  void note_mark(std::size_t field, const WrittenNumber& number);

  std::string_view text_;
  std::string name_;
  char separator_ = ',';
  std::size_t position_ = 0;
  std::size_t line_ = 0;       ///< of the current record's beginning, from 1
  std::size_t next_line_ = 1;  ///< of `position_`
  std::vector<std::string_view> fields_;
  std::deque<std::string> unescaped_;  ///< fields that had doubled quotes
  std::vector<std::pair<std::size_t, std::string>>
      merged_;                ///< columns that are filled down, and their fields
  Example decimal_;           ///< shows the decimal mark of the file
  Example unclear_;           ///< the first number that may have a thousands separator
  bool is_doubtful_ = false;  ///< the separator does not show the mark of some unclear number
  bool has_unclear_length_ = false, has_whole_length_ = false;
  ChangedIds ids_;
};

/// The characters that may separate the fields of a text: that of its line `sep=;`, or those in its first
/// record outside quotes, in their order. The text has no byte order mark.
std::string csv_separators(std::string_view text);

/// Looks up the items that a CSV file names by their ids.
class CsvIdLookup {
 public:
  /// Each item has an `id`. The items must outlive this object. Errors call an item a `kind`.
  /// `ignored`: ids without an item, which the file may name.
  template <class Items>
  CsvIdLookup(const Items& items, std::string_view kind, std::span<const std::string> ignored = {})
      : kind_(kind), ignored_(ignored.begin(), ignored.end()) {
    for (const auto& item : items) {
      index_.emplace(item.id, static_cast<std::uint32_t>(known_.size()));
      known_.push_back(item.id);
    }
  }
  /// The index of the item that a field names. Throws InputError when no item has this id.
  std::uint32_t read(CsvReader& csv, std::size_t field) const;
  /// Whether a field names one of the ignored ids.
  bool is_ignored(CsvReader& csv, std::size_t field) const;

 private:
  std::string_view kind_;
  std::unordered_set<std::string_view> ignored_;
  std::vector<std::string_view> known_;
  std::unordered_map<std::string_view, std::uint32_t> index_;
};

/// `text` in the form for a CSV file: quoted if it would otherwise be read back differently. Spreadsheets
/// take a text that begins with one of = + - @, tab and CR for a formula; with `safe`, an apostrophe before
/// it prevents that. A text with apostrophes before a formula has one more in any case, so that
/// CsvReader::text restores every text.
std::string csv_field(std::string_view text, bool safe = false);

/// `text` in quotes.
std::string csv_quoted(std::string_view text);

}  // namespace shelfbeam
