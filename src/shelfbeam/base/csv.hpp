#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace shelfbeam {

/// Reads comma-separated records (RFC 4180: fields may be quoted, and a quote inside them is doubled). Blanks
/// around unquoted fields and blank lines are ignored. There is no comment syntax.
class CsvReader {
 public:
  /// Errors name the file as `name`. The text must outlive the reader.
  CsvReader(std::string_view text, std::string name);

  /// Moves to the next record; false at the end.
  bool next();
  /// The current record; valid until `next`.
  const std::vector<std::string_view>& fields() const { return fields_; }

  /// The field as a number; throws InputError unless it is finite.
  double number(std::size_t field) const;
  /// The field as a number; throws InputError unless it is finite and not negative.
  double amount(std::size_t field) const;
  /// The field as an id; throws InputError when it is empty.
  std::string id(std::size_t field) const;

  /// "file: line 3" for errors.
  std::string where() const;
  /// Throws InputError with the file, the line and, if given, the field (index from 0).
  [[noreturn]] void fail(const std::string& problem, const std::string& suggestion) const;
  [[noreturn]] void fail(std::size_t field, const std::string& problem, const std::string& suggestion) const;

 private:
  std::string_view quoted_field();

  std::string_view text_;
  std::string name_;
  std::size_t position_ = 0;
  std::size_t line_ = 0;       ///< of the current record's beginning, from 1
  std::size_t next_line_ = 1;  ///< of `position_`
  std::vector<std::string_view> fields_;
  std::deque<std::string> unescaped_;  ///< fields that had doubled quotes
};

/// Looks up the items that a CSV file names by their ids.
class CsvIdLookup {
 public:
  /// Each item has an `id`. The items must outlive this object. Errors call an item a `kind`.
  template <class Items>
  CsvIdLookup(const Items& items, std::string_view kind) : kind_(kind) {
    for (const auto& item : items) {
      index_.emplace(item.id, static_cast<std::uint32_t>(known_.size()));
      known_.push_back(item.id);
    }
  }
  /// The index of the item that a field names. Throws InputError when no item has this id.
  std::uint32_t read(const CsvReader& csv, std::size_t field) const;

 private:
  std::string_view kind_;
  std::vector<std::string_view> known_;
  std::unordered_map<std::string_view, std::uint32_t> index_;
};

/// `field` in the form for a CSV file: quoted if it would otherwise be read back differently.
std::string csv_field(std::string_view field);

}  // namespace shelfbeam
