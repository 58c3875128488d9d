#pragma once

#include "placement_instances.hpp"

namespace shelfbeam::bench {

/// Prints the size of the non-cooperative problem after reductions, and the lower bounds on the cooperative
/// count that linear programs prove with every back end.
void print_bounds(const InstanceChoice& choice, double limit);

}  // namespace shelfbeam::bench
