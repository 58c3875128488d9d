#pragma once

#include "placement_instances.hpp"

namespace shelfbeam::bench {

/// Prints, as a Markdown table, the steps of the search for the count, for half as many units, for 95 % of
/// the labels and for unit failure, both models, with the value and the bound that each of them improved.
void print_steps(const InstanceChoice& choice, double limit);

}  // namespace shelfbeam::bench
