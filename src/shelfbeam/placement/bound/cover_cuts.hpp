#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/bound/dual_bound.hpp"

namespace shelfbeam::detail {

/// Knapsack cover inequalities (dual_bound.hpp) of the given labels that `x` violates, the most violated
/// first, at most one a label and `most` in all. For every label, A grows by the columns of largest x as long
/// as it lacks something; the A that is violated most counts.
std::vector<BoundRow> cover_cuts(const SignalTable& table, const Question& question,
                                 std::span<const std::uint32_t> labels, std::span<const double> x,
                                 std::size_t most);

/// The same of inequalities with a share, for answers of at most `most_units` units: of 24 shares for every
/// label, that which is violated most.
std::vector<BoundRow> share_cuts(const SignalTable& table, const Question& question, std::size_t most_units,
                                 std::span<const std::uint32_t> labels, std::span<const double> x,
                                 std::size_t most);

}  // namespace shelfbeam::detail
