#pragma once

#include <cstdint>
#include <vector>

namespace shelfbeam {

/// The value that a standard normal variate stays below with probability p, 0 < p < 1. By symmetry the value
/// that it exceeds with a small probability q is -normal_quantile(q), exact where 1 - q would round.
double normal_quantile(double p);

/// The same for Student's t; infinite degrees of freedom are the normal distribution.
double student_quantile(double p, double degrees_of_freedom);

/// The probability that chi-square with these degrees of freedom is at least x.
double chi_square_upper_tail(double x, double degrees_of_freedom);

/// The largest chance of success that so many successes in so many independent trials leave possible: with
/// any larger one so few have a chance below `level` (Clopper, Pearson 1934).
double success_limit(std::uint64_t successes, std::uint64_t trials, double level);

/// The level for each of `statements` independent statements whose joint level is `level`:
/// 1 - (1 - level)^(1 / statements) (Sidak 1967). Where dependence is unknown it is Bonferroni's to first
/// order.
double sidak_level(double level, double statements);

/// Quantile q in [0, 1] of values with linear interpolation between order statistics; 0 for no values.
double quantile(std::vector<double> values, double q);

}  // namespace shelfbeam
