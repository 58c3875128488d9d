#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// Size limits of the methods, suited to two cores and a minute. Entries are stored signals, places are cells
/// of the matrix (m n).
struct SearchLimits {
  std::size_t max_units_of_trees = 40;
  std::size_t max_cells_of_trees = 20'000'000;
  std::size_t max_cells_of_local_search = max_cells_of_walks;
  std::size_t small_answer = 9;                ///< count up to which a tree search may end within seconds
  std::size_t max_mip_entries = 400'000;       ///< for cooperative problems
  std::size_t max_model_entries = 20'000'000;  ///< of the whole model if no selection is known
  std::size_t max_small_lp_entries = 5'000'000;
  std::size_t max_checked_steps = 1'000'000;  ///< of a tree's log
};

/// Solves a placement problem by local search, LP bounds, tree search and, if a gap remains, a MIP on the
/// remainder of the reductions; or by a MIP back end alone, if the options ask for it, or allow it and no
/// `start` is known; otherwise not at all, with the bounds that need no search. `start` is a selection that
/// the checker accepts. The next of `backends` follows if one fails. The deadline replaces the time limit of
/// the options. If the search closes the gap, it settles ties (`settle_ties`) within a work limit, so that
/// the result is the same for any number of threads even if ties stay open. The result has no `problem`,
/// `unit_costs` and `seconds`.
Placement search_placement(const Instance& instance, const std::optional<Selection>& start,
                           std::span<const milp::Backend> backends, const PlaceOptions& options,
                           const Deadline& deadline, const RunControl& control,
                           const SearchLimits& limits = {});

/// A feasible selection, by local search from an infeasible one (conflicts can block the greedy method);
/// nullopt if none is found.
std::optional<Selection> first_selection(const Instance& instance, const Selection& start,
                                         double time_limit_s, std::uint64_t seed, const RunControl& control);

}  // namespace shelfbeam::detail
