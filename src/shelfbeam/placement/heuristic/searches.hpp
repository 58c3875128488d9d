#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

// Heuristic searches for a better selection; nullopt if none is found. Walks use `seed` and the following
// seeds.
namespace shelfbeam::detail {

/// Walks keep the whole matrix if labels x candidates are at most this number; one float each.
inline constexpr std::size_t max_cells_of_walks = 250'000'000;

/// A selection better than `start` (fewer units, or less cost if weighted), or any feasible selection if
/// `start` is infeasible. Weighted exchanges as for set covering (Gao and others 2015), on a growing set of
/// rows. Results have passed received_signal on all rows.
std::optional<Selection> local_search(const Instance& instance, const SearchMatrix& all,
                                      const Selection& start, const Effort& effort, std::uint32_t seed,
                                      const RunControl& control);

/// Whether `anneal` applies: lexicographic.
bool can_anneal(const PlacementProblem& problem);

/// A feasible selection with fewer units than `start`, or with at most as many if `start` is infeasible:
/// simulated annealing (Kirkpatrick, Gelatt and Vecchi, Science 220, 1983) of the total lack L(T) at a fixed
/// count, which falls by one whenever a selection passes received_signal. A move exchanges one unit, mostly
/// for one with similar signals, and costs one scan of the active rows.
std::optional<Selection> anneal(const Instance& instance, const SearchMatrix& all, const Selection& start,
                                const Effort& effort, std::uint32_t seed, const RunControl& control);

/// A selection better than `start` (fewer units, or less cost if weighted), for non-cooperative problems
/// without unit failure: row-weighting search for set covering (Gao and others, Eur. J. Oper. Res. 246, 2015)
/// on the remainder of `reduction`, which is for the first objective. Moves need no scan of the matrix.
std::optional<Selection> cover_search(const Instance& instance, const Reduction& reduction,
                                      const Selection& start, const Effort& effort, std::uint32_t seed,
                                      const RunControl& control);

}  // namespace shelfbeam::detail
