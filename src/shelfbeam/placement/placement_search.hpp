#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam::detail {

/// Who is asked for linear and mixed-integer programs, in this order: the next where one fails.
struct Solvers {
  std::span<const milp::Backend> preferred;
  bool only_linear = false;  ///< no mixed-integer programs: no solver has a part in the answer or its proof
};

/// What is too much for what; the defaults suit two cores and a minute. Entries and places are of the matrix.
struct SearchLimits {
  std::size_t most_units_of_trees = 40;
  std::size_t most_places_of_trees = 20'000'000;
  std::size_t most_places_of_local_search = 250'000'000;  ///< a float each
  std::size_t small_answer = 9;                           ///< units with which a tree may end within seconds
  std::size_t most_mip_entries = 400'000;                 ///< where units cooperate
  std::size_t most_model_entries = 20'000'000;            ///< of a whole model where no selection is known
  std::size_t most_small_lp_entries = 5'000'000;
  std::size_t most_checked_steps = 1'000'000;  ///< of a tree's log
  bool settles_ties = true;
  std::optional<std::uint64_t> step_limit = {};  ///< PlaceOptions::step_limit
};

/// Answers a question by local search, linear programming, tree search and, where these leave a gap, a MIP on
/// what reductions leave. `start` is a selection that the checker accepts. The answer lacks `seconds`.
///
/// Where the tree search ends by proof, ties are settled, too: of all placements that cost the same, that
/// with the largest smallest margin, of these that with the fewest units, of these the first by id. Ties are
/// searched with limited work, so that the answer is the same for any number of threads even where they are
/// too many to be settled.
Placement search_placement(const SignalTable& table, const Question& question,
                           const std::vector<std::uint32_t>& start, const Solvers& solvers,
                           double time_limit_s, std::uint64_t seed, const RunControl& control,
                           const SearchLimits& limits = {});

/// Some selection that meets every label, by local search from one that does not (the greedy method gets
/// stuck where candidates exclude one another). Nothing where none was found.
std::optional<std::vector<std::uint32_t>> first_selection(const SignalTable& table, const Question& question,
                                                          const std::vector<std::uint32_t>& start,
                                                          double time_limit_s, std::uint64_t seed,
                                                          const RunControl& control);

}  // namespace shelfbeam::detail
