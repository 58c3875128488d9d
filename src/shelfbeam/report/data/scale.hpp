#pragma once

#include <vector>

namespace shelfbeam {

/// The least of 1, 2, 2.5, 5 times a power of ten that is not below `step`.
double round_step(double step);

/// Multiples of `step` within [low, high].
std::vector<double> multiples(double low, double high, double step);

/// 1, 2, 5 times powers of ten that enclose [low, high], low > 0.
std::vector<double> one_two_five(double low, double high);

}  // namespace shelfbeam
