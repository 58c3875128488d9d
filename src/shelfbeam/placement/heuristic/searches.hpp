#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/placement/kernels/search_problem.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

// Searches for a better selection. Walks begin with `seed` and those that follow. Nothing where none was
// found.
namespace shelfbeam::detail {

/// A better selection than `start`: one of fewer units (lexicographic) or of less cost (weighted), or any
/// that meets every label where `start` does not, by exchanges with weights on rows that stay unmet (as in
/// weighting searches for set covering, Gao et al. 2015), on the rows that have been unmet so far. Whatever
/// is returned has passed the contract's rule on all rows.
std::optional<Selection> local_search(const SearchProblem& problem, const SearchMatrix& all,
                                      const Selection& start, const Effort& effort, std::uint32_t seed,
                                      const RunControl& control);

/// Whether `anneal` takes this question: the fewest units (lexicographic), signals that add up, and no unit
/// may fail.
bool can_anneal(const Question& question);

/// A selection of fewer units than `start` that meets every label, or any that does where `start` does not
/// but has enough units: simulated annealing (Kirkpatrick, Gelatt and Vecchi, Science 220, 1983) of what the
/// labels lack in all, for a number of units that falls by one whenever a selection passes the contract's
/// rule. A move exchanges one unit for another, mostly for one whose signals are like its own, and costs one
/// scan of the rows that were ever unmet.
std::optional<Selection> anneal(const SearchProblem& problem, const SearchMatrix& all, const Selection& start,
                                const Effort& effort, std::uint32_t seed, const RunControl& control);

/// Whether `cover_search` takes this question: the fewest units (lexicographic), each label reached by one,
/// and no candidates that exclude one another.
bool is_plain_cover(const SignalTable& table, const Question& question);

/// A selection of fewer units than `start`, which meets every label, by a search for set covering with
/// weights on rows (Gao and others, Engineering Applications of Artificial Intelligence 38, 2015), on what
/// `reduction` (of the number of units) leaves. A move costs what its columns reach and not a scan of the
/// matrix.
std::optional<Selection> cover_search(const SignalTable& table, const Question& question,
                                      const Reduction& reduction, const Selection& start,
                                      const Effort& effort, std::uint32_t seed, const RunControl& control);

}  // namespace shelfbeam::detail
