#include "support/hypothesis.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

double score(double value, double reference, double standard_error) {
  const double difference = std::abs(value - reference);
  if (difference == 0 && standard_error >= 0) return 0;
  const double z = difference / standard_error;
  return z >= 0 ? z : std::numeric_limits<double>::infinity();  // NaN, or a negative standard error
}

}  // namespace

ZTest z_test(std::span<const double> values, std::span<const double> references,
             std::span<const double> standard_errors, double level, double degrees_of_freedom) {
  if (values.empty() || references.size() != values.size() || standard_errors.size() != values.size())
    throw std::invalid_argument("z_test: no values, or spans of different sizes");
  ZTest test;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double z = score(values[i], references[i], standard_errors[i]);
    if (z > test.largest) {
      test.largest = z;
      test.worst = i;
    }
  }
  const double each = sidak_level(level, static_cast<double>(values.size()));
  test.limit = -student_quantile(each / 2, degrees_of_freedom);
  test.pass = test.largest <= test.limit;
  return test;
}

ChiSquareTest chi_square_test(std::span<const double> counts, std::span<const double> expected, double level,
                              std::size_t tests, double pool_below) {
  if (counts.size() != expected.size())
    throw std::invalid_argument("chi_square_test: spans of different sizes");
  if (std::any_of(expected.begin(), expected.end(), [](double e) { return !(e >= 0) || std::isinf(e); }))
    throw std::invalid_argument("chi_square_test: an expectation is negative or not finite");
  std::vector<std::size_t> order(counts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return expected[a] < expected[b]; });

  ChiSquareTest test;
  bool impossible = false;
  std::size_t cells = 0;
  double pooled_count = 0, pooled_expected = 0;
  const auto close_pool = [&] {
    const double difference = pooled_count - pooled_expected;
    test.statistic += difference * difference / pooled_expected;
    ++cells;
    pooled_count = pooled_expected = 0;
  };
  for (const std::size_t cell : order) {
    if (expected[cell] == 0) {
      impossible |= counts[cell] != 0;
      continue;
    }
    pooled_count += counts[cell];
    pooled_expected += expected[cell];
    if (pooled_expected >= pool_below) close_pool();
  }
  if (pooled_expected > 0) close_pool();  // only if all cells together expect less than `pool_below`
  if (cells < 2) throw std::invalid_argument("chi_square_test: fewer than two cells");

  test.degrees_of_freedom = static_cast<double>(cells - 1);
  test.p_value = impossible ? 0 : chi_square_upper_tail(test.statistic, test.degrees_of_freedom);
  test.level = sidak_level(level, static_cast<double>(tests));
  test.pass = test.p_value >= test.level;
  return test;
}

}  // namespace shelfbeam
