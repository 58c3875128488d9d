#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shelfbeam {

/// The mean of values in a random-effects model: every value has a known standard error, and all share an
/// unknown spread, which is estimated. Huber's M-estimator: a value has the weight
/// 1 / (standard_error^2 + spread^2), and less beyond 1.345 standard deviations.
struct RobustMean {
  double value = 0;
  double spread = 0;               ///< spread beyond the standard errors; 0 if they explain all
  std::vector<double> deviations;  ///< sqrt(standard_error^2 + spread^2) of every value
  std::vector<double> weights;     ///< of the last iteration
  std::vector<double> influences;  ///< contribution of every value to the error of the mean; they sum to 0
  double effective_count = 0;      ///< (sum w)^2 / sum w^2 before outliers lose weight
};

/// The spread is chosen such that half of the values lie within 0.6745 standard deviations of their median.
/// Precondition: at least two values and one standard error per value, each finite and not negative.
RobustMean robust_mean(std::span<const double> values, std::span<const double> standard_errors);

/// The standard error of a sum of influences that are dependent only within groups (Liang and Zeger 1986),
/// times sqrt(G / (G - 1)) for G groups. `groups` holds the group of every influence.
struct GroupedError {
  double standard_error = 0;
  std::size_t groups = 0;
};
GroupedError grouped_error(std::span<const double> influences, std::span<const std::uint32_t> groups);

}  // namespace shelfbeam
