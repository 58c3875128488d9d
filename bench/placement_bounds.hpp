#pragma once

#include <string>
#include <vector>

namespace shelfbeam::bench {

/// What reductions leave of the non-cooperative count, and what linear programs prove about the cooperative
/// one, with every back end.
void print_bounds(const std::vector<std::string>& files, const std::vector<double>& scales, double limit);

}  // namespace shelfbeam::bench
