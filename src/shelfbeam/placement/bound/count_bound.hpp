#pragma once

#include <cstddef>

#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// A proven lower bound on the count.
struct CountBound {
  std::size_t count = 0;  ///< no selection of the options' set has fewer units
  LpBound relaxation;     ///< of the count without a limit
  bool complete = false;  ///< the time limit ended no LP
};

/// The LP bound on the count, rounded up to k, for the selections of `options`, which do not limit the count;
/// `options.rows` are the first rows. While the LP bound for selections of at most k units exceeds
/// k, which proves that there are none, or `prove_count_exceeds` proves it, k becomes k + 1.
CountBound count_bound(const Instance& instance, const milp::Backend& backend, const LpBoundOptions& options,
                       const RunControl& control);

/// Proves by cases that every selection of `selections` has more than its maximum count of units, if `open`,
/// the LP bound for at most that many, falls short by at most a half. Either some unit contributes the share
/// t or more to label i, or none does:
///
///   sum_{j: a_ij >= t} T_j >= 1      or      T_j = 0 for every j with a_ij >= t.
///
/// Each case has its own LP bound and is divided again if required. Ends after 64 cases, at the time limit or
/// when cancelled; false if nothing was proven.
bool prove_count_exceeds(const Instance& instance, const milp::Backend& backend,
                         const SelectionSet& selections, const LpBound& open, const Effort& effort,
                         const RunControl& control);

}  // namespace shelfbeam::detail
