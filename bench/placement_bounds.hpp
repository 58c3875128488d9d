#pragma once

#include <string>
#include <vector>

namespace shelfbeam::bench {

/// Prints the size of the non-cooperative problem after reductions, and the lower bounds on the cooperative
/// count that linear programs prove with every back end.
void print_bounds(const std::vector<std::string>& files, const std::vector<double>& scales, double limit);

}  // namespace shelfbeam::bench
