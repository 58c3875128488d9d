#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace shelfbeam {

/// What a set of values says to the claim that they are estimates of their references.
struct ZTest {
  double largest = 0;     ///< |value - reference| / standard error, of the worst value
  std::size_t worst = 0;  ///< which value that is
  double limit = 0;       ///< what `largest` may be
  bool pass = false;
};

/// Compares values with references, all at once: when the claim is true the test fails with probability
/// `level`, however many values there are (Sidak correction of the two-sided test).
///
/// `standard_errors` are those of the differences (std::hypot of both where the reference has one, too).
/// Where they were estimated from B batches, pass B - 1 as `degrees_of_freedom`. A standard error of 0
/// demands equality; NaN anywhere fails. Throws std::invalid_argument for no values or spans of different
/// sizes.
ZTest z_test(std::span<const double> values, std::span<const double> references,
             std::span<const double> standard_errors, double level,
             double degrees_of_freedom = std::numeric_limits<double>::infinity());

/// What counts in cells say to the claim that they were drawn with these expectations.
struct ChiSquareTest {
  double statistic = 0;
  double degrees_of_freedom = 0;
  double p_value = 0;
  double level = 0;  ///< what `p_value` must reach
  bool pass = false;
};

/// Pearson's test of counts against expected counts, which must have the same sum but for what the claim has
/// wrong. Cells that expect less than `pool_below` are pooled, the smallest first, until the pool expects
/// that much; a count where nothing is expected fails. The joint level of `tests` such tests is `level`.
/// Throws std::invalid_argument for spans of different sizes, negative or non-finite expectations, and fewer
/// than two cells after pooling (such a test could not fail).
ChiSquareTest chi_square_test(std::span<const double> counts, std::span<const double> expected, double level,
                              std::size_t tests = 1, double pool_below = 5);

}  // namespace shelfbeam
