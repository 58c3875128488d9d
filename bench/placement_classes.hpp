#pragma once

#include <cstddef>

namespace shelfbeam::bench {

/// Solves random weighted covers of every class with our search and every MIP solver alone, on one thread,
/// and prints the median CPU times to the proof and the ratio to the faster solver. `limit` is in seconds per
/// run.
void compare_classes(std::size_t seeds, double limit);

/// Prints value and bound of our search and of every MIP solver on a cover of 500 rows by 60,000
/// columns, `limit` in seconds each.
void compare_wide(double limit);

}  // namespace shelfbeam::bench
