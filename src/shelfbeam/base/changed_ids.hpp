#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "shelfbeam/base/finding/finding.hpp"

namespace shelfbeam {

/// Collects ids that a spreadsheet or another program has probably changed: numbers in scientific notation
/// ("4,00638E+12"), with decimals ("123.0"), with thousands separators or rounded to 15 digits, dates,
/// formulas, error values ("#N/A"), missing values ("NaN"), and numbers that another line has with zeros
/// before them.
class ChangedIds {
 public:
  void note(std::string_view id, std::size_t line);
  /// The warning about a file, which names the first ids and their lines; nothing if there are none.
  std::optional<Finding> warning(const std::string& file) const;

 private:
  struct Id {
    std::string id;
    std::vector<std::size_t> lines;  ///< the first
    std::size_t count = 0;           ///< of all lines
  };
  void note_zeros(std::string_view id, std::size_t line);
  static void add(std::vector<Id>& ids, std::string_view id, std::size_t line);

  std::vector<Id> changed_;
  std::vector<Id> whole_, rounded_;  ///< numbers such as "123.0", and those with zeros from the 16th digit on
  std::unordered_map<std::string, std::pair<std::size_t, std::size_t>> zeros_;  ///< and first line, by digits
  std::vector<Id> without_zeros_;
  bool has_fractions_ = false;  ///< there are ids such as "1.2", so "1.0" is one of them
  bool has_long_ = false;       ///< there are longer numbers with other digits
};

/// The remedy for a wrong id: `remedy`, or that its column has to be kept as text.
std::string id_remedy(std::string_view id, std::string_view remedy);

}  // namespace shelfbeam
