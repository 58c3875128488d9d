#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace shelfbeam {

/// A mean of values whose errors are known in part: each has a known standard error, and all have a spread in
/// common that is not known and is estimated (a random-effects model). Huber's M-estimator: a value counts as
/// 1 / (standard_error^2 + spread^2), and less from 1.345 standard deviations on.
struct RobustMean {
  double value = 0;
  double spread = 0;               ///< what the standard errors leave unexplained; 0 where they explain all
  std::vector<double> deviations;  ///< sqrt(standard_error^2 + spread^2) of every value
  std::vector<double> weights;     ///< the final ones
  std::vector<double> influences;  ///< what every value contributes to the error of the mean; they sum to 0
  double effective_count = 0;      ///< (sum w)^2 / sum w^2 before outliers lose weight
};

/// The spread is such that half of the values lie within 0.6745 standard deviations of their median.
/// Precondition: two values or more, as many standard errors, each finite and not negative.
RobustMean robust_mean(std::span<const double> values, std::span<const double> standard_errors);

/// The standard error of a sum of influences that are independent between groups and arbitrary within
/// (Liang and Zeger 1986), times sqrt(G / (G - 1)) for G groups. `groups` names the group of every influence.
struct GroupedError {
  double standard_error = 0;
  std::size_t groups = 0;
};
GroupedError grouped_error(std::span<const double> influences, std::span<const std::uint32_t> groups);

}  // namespace shelfbeam
