#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// Share cuts (BoundRow) of the given labels that `x` violates, for selections of at most `max_units` units:
/// the most violated first, at most one per label, of 24 shares, and `max_cuts` in all.
std::vector<BoundRow> share_cuts(const Instance& instance, std::size_t max_units,
                                 std::span<const LabelId> labels, std::span<const double> x,
                                 std::size_t max_cuts);

}  // namespace shelfbeam::detail
