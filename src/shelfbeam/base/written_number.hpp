#pragma once

#include <optional>
#include <string_view>

#include "shelfbeam/base/length_unit.hpp"

namespace shelfbeam {

/// A number as people and spreadsheets write it. The page reads numbers by the same rules
/// (src/page/planner/geometry/written_number.ts); test/data/written_numbers.tsv has the cases of both.
///
///   1.25   1,25   1250   -0,5   .5   1.5e-3   5 1/2        a decimal point or comma, a fraction
///   1,250.5   1.250,5   1.250.000   1 250   1'250          with marks of thousands
///   25 cm   0,25 m   10"   49 in   12'-6"   12' 6 1/2"     with units of length
///
/// A single mark before three digits, as in "1,250", is unclear: a decimal mark, or one of thousands. No
/// country separates thousands of feet or inches by points.
struct WrittenNumber {
  double value = 0;                ///< in `unit`; of an unclear number, that with decimals
  std::optional<double> grouped;   ///< of an unclear number, that with thousands
  std::optional<LengthUnit> unit;  ///< of several, the last one: 12'-6" is 150 in
  char mark = 0;                   ///< '.' or ',' of the decimals; 0 if the number does not show it
};

/// Empty for a text that is not a number, and for one like 12'-6 that may be a difference.
std::optional<WrittenNumber> written_number(std::string_view text);

}  // namespace shelfbeam
