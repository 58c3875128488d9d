#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/states/state_table.hpp"

namespace shelfbeam {

/// A selection that misses no label in more states than allowed, and a bound on all of these.
struct StatePlacement {
  std::vector<std::uint32_t> selected;  ///< ascending; with every installed unit
  std::vector<std::uint32_t> misses;    ///< of each label, by misses_of
  /// Count or new spend; infinite if no selection was found.
  double value = std::numeric_limits<double>::infinity();
  double lower_bound = 0;  ///< proven for these states; infinite if no selection exists
  /// Labels that are missed too often even with all candidates, or the best options of all mounting points.
  std::vector<std::uint32_t> unreachable;
  std::size_t calls = 0, cuts = 0;  ///< placements on cuts, and cuts

  bool has_selection() const { return value < std::numeric_limits<double>::infinity(); }
  bool is_proven() const { return value <= lower_bound * (1 + 1e-9); }
};

/// Finds the selection of the fewest units, or of the smallest new spend, for which label i is missed in at
/// most allowed[i] of the states, both communication models, with all constraints.
///
/// The bound comes from cuts, which every such selection satisfies. For label i with k allowed misses and any
/// set T of t > k states, at least t - k states of T have sum_j min(1, M_ijs / requirement_i) x_j >= 1.
/// The mean over them gives sum_j a_j x_j >= 1, a_j the mean of the t - k largest shares of unit j in T. If
/// label i is missed too often even with all units of a set W, another unit is required: sum over j not in W
/// of x_j >= 1. `place` solves the cuts exactly; a selection that misses a label too often violates new ones.
/// With unit failure, the strongest unit is omitted from the sums, and sets W give no cuts.
///
/// Throws InputError for an objective other than the count or the spend, and as `place`.
StatePlacement place_over_states(const StateTable& states, const PlacementProblem& problem,
                                 std::span<const std::uint32_t> allowed, const PlaceOptions& options,
                                 const RunControl& control = {});

}  // namespace shelfbeam
