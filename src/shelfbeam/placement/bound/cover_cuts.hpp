#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/bound/dual_bound.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// Knapsack cover cuts (BoundRow) of the given labels that `x` violates, the most violated first, at most one
/// per label and `max_cuts` in all. For every label, A grows in order of decreasing x_j while the label lacks
/// something; the most violated cut is kept.
std::vector<BoundRow> cover_cuts(const Instance& instance, std::span<const std::uint32_t> labels,
                                 std::span<const double> x, std::size_t max_cuts);

/// Share cuts (BoundRow) in the same way, for selections of at most `max_units` units: for every label the
/// most violated of 24 shares.
std::vector<BoundRow> share_cuts(const Instance& instance, std::size_t max_units,
                                 std::span<const std::uint32_t> labels, std::span<const double> x,
                                 std::size_t max_cuts);

}  // namespace shelfbeam::detail
