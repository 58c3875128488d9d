#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/kernels/search_instance.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"

namespace shelfbeam::detail {

/// Whether annealing can hold all labels x candidates of the table.
bool can_anneal_coverage(const SignalTable& table);

/// A selection with fewer units than `start` that reaches labels of the weight `target`, or with at most as
/// many if `start` does not; nullopt if none is found. The annealing of `anneal`, but of the missed weight
/// beyond the weight that may be missed, on all labels. Precondition: can_anneal_coverage.
std::optional<Selection> anneal_reach(const SearchInstance& instance, const SearchMatrix& all,
                                      const LabelWeights& weights, double target, const Selection& start,
                                      const Effort& effort, std::uint32_t seed, const RunControl& control);

/// A selection of as many units as `start` that reaches labels of more weight than `reached`; nullopt if none
/// is found. The same annealing at a fixed count: whenever a selection reaches more, it must reach still more
/// from then on. Precondition: can_anneal_coverage.
std::optional<Selection> anneal_coverage(const SearchInstance& instance, const SearchMatrix& all,
                                         const LabelWeights& weights, double reached, const Selection& start,
                                         const Effort& effort, std::uint32_t seed, const RunControl& control);

/// Anneals with other seeds until the time is up or `is_done`, or once if the options limit the steps. Calls
/// run(instance, matrix, effort, seed) with at most `moves` moves each.
template <class IsDone, class Run>
void anneal_repeatedly(const SignalTable& table, const PlacementProblem& problem, const PlaceOptions& options,
                       std::uint64_t moves, std::chrono::steady_clock::time_point until,
                       const RunControl& control, const IsDone& is_done, const Run& run) {
  const SearchInstance instance(table, problem);
  const SearchMatrix matrix(table, problem.model);
  const Effort effort{std::min(moves, options.step_limit.value_or(moves)), until};
  auto seed = static_cast<std::uint32_t>(mix_key(options.seed, 0));
  while (!is_done() && !effort.is_over(control)) {
    run(instance, matrix, effort, seed);
    seed += walks_at_once;
    if (options.step_limit) break;
  }
}

}  // namespace shelfbeam::detail
