#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace shelfbeam {

/// The result of testing whether values are estimates of their references.
struct ZTest {
  double largest = 0;     ///< |value - reference| / standard error, of the worst value
  std::size_t worst = 0;  ///< index of the worst value
  double limit = 0;       ///< largest accepted value of `largest`
  bool pass = false;
};

/// Compares all values with their references together: if the claim is true, the test fails with probability
/// `level` for any number of values (Sidak correction of the two-sided test).
///
/// `standard_errors` are those of the differences (std::hypot of both if the reference has one, too). If they
/// were estimated from B batches, pass B - 1 as `degrees_of_freedom`. A standard error of 0 requires
/// equality; any NaN fails. Throws std::invalid_argument for no values or spans of different sizes.
ZTest z_test(std::span<const double> values, std::span<const double> references,
             std::span<const double> standard_errors, double level,
             double degrees_of_freedom = std::numeric_limits<double>::infinity());

/// The result of testing whether counts in cells were drawn with the given expectations.
struct ChiSquareTest {
  double statistic = 0;
  double degrees_of_freedom = 0;
  double p_value = 0;
  double level = 0;  ///< smallest accepted `p_value`
  bool pass = false;
};

/// Pearson's test of counts against expected counts, whose sums must be equal unless the claim is wrong.
/// Cells with expectations below `pool_below` are pooled, the smallest first, until the pool expects that
/// much. A count in a cell with expectation 0 fails. The joint level of `tests` such tests is `level`. Throws
/// std::invalid_argument for spans of different sizes, negative or non-finite expectations, and fewer than
/// two cells after pooling (such a test could not fail).
ChiSquareTest chi_square_test(std::span<const double> counts, std::span<const double> expected, double level,
                              std::size_t tests = 1, double pool_below = 5);

}  // namespace shelfbeam
