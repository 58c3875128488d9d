#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/kernels/effort.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/search_problem.hpp"

namespace shelfbeam::detail {

/// Whether `anneal` takes this question: the fewest units (lexicographic), signals that add up, and no unit
/// may fail.
bool can_anneal(const Question& question);

/// A selection of fewer units than `start` that meets every label, or any that does where `start` does not
/// but has enough units: simulated annealing (Kirkpatrick, Gelatt and Vecchi, Science 220, 1983) of what the
/// labels lack in all, for a number of units that falls by one whenever a selection passes the contract's
/// rule. A move exchanges one unit for another, mostly for one whose signals are like its own, and costs one
/// scan of the rows that were ever unmet. Walks begin with `seed` and those that follow. Nothing where none
/// was found.
std::optional<std::vector<std::uint32_t>> anneal(const SearchProblem& problem, const SearchMatrix& all,
                                                 const std::vector<std::uint32_t>& start,
                                                 const Effort& effort, std::uint32_t seed,
                                                 const RunControl& control);

}  // namespace shelfbeam::detail
