#pragma once

#include <cstdint>
#include <vector>

namespace shelfbeam {

/// The p-quantile of the standard normal distribution, 0 < p < 1. For a small upper tail q use
/// -normal_quantile(q), which avoids the rounding of 1 - q.
double normal_quantile(double p);

/// The p-quantile of Student's t distribution; infinite degrees of freedom give the normal distribution.
double student_quantile(double p, double degrees_of_freedom);

/// The probability that chi-square with these degrees of freedom is at least x.
double chi_square_upper_tail(double x, double degrees_of_freedom);

/// Upper confidence limit of a success probability (Clopper, Pearson 1934): with any larger probability,
/// `successes` or fewer successes in `trials` independent trials are less probable than `level`.
double success_probability_upper_limit(std::uint64_t successes, std::uint64_t trials, double level);

/// The level for each of `statements` independent statements whose joint level is `level`:
/// 1 - (1 - level)^(1 / statements) (Sidak 1967). To first order it equals Bonferroni's level, which requires
/// no independence.
double sidak_level(double level, double statements);

/// The q-quantile, q in [0, 1], by linear interpolation between order statistics; 0 without values.
double quantile(std::vector<double> values, double q);

}  // namespace shelfbeam
