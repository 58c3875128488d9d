#pragma once

#include <vector>

namespace shelfbeam {

/// Quantile q in [0, 1] with linear interpolation between order statistics; 0 for no values.
double quantile(std::vector<double> values, double q);

}  // namespace shelfbeam
