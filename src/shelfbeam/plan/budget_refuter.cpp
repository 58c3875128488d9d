#include "shelfbeam/plan/budget_refuter.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/refutation_effort.hpp"

namespace shelfbeam {

namespace {

// Leaves list columns: these many in all leaves take some 200 MB.
constexpr std::size_t max_leaves = 400'000, max_columns_of_leaves = 50'000'000;
// Share of the budget that is left, for the search for a refutation.
constexpr double share_of_refutation = 0.1;
constexpr double no_limit = 1e8;          ///< seconds
constexpr double seconds_of_search = 60;  ///< if the budget is in samples
constexpr double reserve_of_repeat = 1.25;
// Searches in vain without a counterexample take long, and more samples rarely help.
constexpr int max_failures = 2;

}  // namespace

void BudgetRefuter::forget_failures() {
  for (auto& [bound, progress] : progress_) {
    progress.has_failed = false;
    if (progress.pending && !progress.pending->is_repeat) progress.pending.reset();
  }
}

BudgetRefuter::Attempt BudgetRefuter::attempt(const BoundGoal& goal, double bound,
                                              const PlannedSignals& signals, double share) {
  Attempt attempt;
  Progress& progress = progress_[bound];
  if (progress.has_failed || progress.failures >= max_failures) return attempt;
  rounds_.report(Task::proving, fmt::format("whether {}", goal.text(bound)));
  const auto cost_of = [&](const Promising& one) {
    return rounds_.cost(TracedUnits::all) * static_cast<double>(one.refutation.labels.size());
  };
  const auto affordable = [&](const Promising& one, double part) {
    return rounds_.affordable(one.wanted, one.needed, cost_of(one) / part);
  };
  // If a repetition exceeds the budget, its leaves are split, which takes fewer batches.
  if (progress.pending && progress.pending->is_repeat && affordable(*progress.pending, 1) == 0)
    progress.pending.reset();
  auto found = progress.pending ? std::exchange(progress.pending, {})
                                : promising(goal, bound, progress, signals, attempt.counterexample);
  if (!found) {
    progress.has_failed = true;
    if (attempt.counterexample.empty()) ++progress.failures;
    return attempt;
  }
  attempt.labels = found->refutation.labels.size();
  const std::uint32_t batches = affordable(*found, share);
  if (batches == 0) {
    if (share < 1) {
      progress.pending = std::move(found);
    } else {
      attempt.cost = cost_of(*found) * found->wanted;
      progress.has_failed = true;
    }
    return attempt;
  }
  rounds_.report(Task::proving, fmt::format("{} labels, {} batches", attempt.labels, batches));
  const double begun = rounds_.spent();
  TestedRefutation tested =
      test_refutation(prepared_, found->refutation, signals.table,
                      rounds_.request(Purpose::bound, found->refutation.labels, batches), rounds_.level(),
                      Deadline(rounds_.counts_samples() ? no_limit : rounds_.left()), rounds_.control());
  rounds_.measure(begun, tested.fresh);
  attempt.is_tested = true;
  attempt.is_proven = tested.open.empty();
  attempt.fresh = std::move(tested.fresh);
  progress.min_batches = std::min(progress.min_batches * 3 / 2, Rounds::max_batches);
  if (tested.needed < Rounds::max_batches && !found->is_repeat) {
    found->refutation.leaves = tested.open;
    progress.pending = {used_part(std::move(found->refutation)), tested.needed,
                        std::max<double>(progress.min_batches, reserve_of_repeat * tested.needed), true};
  }
  progress.open = std::move(tested.open);
  return attempt;
}

// A refutation of the matrix with the largest reserve that allows one, and the batches that it is expected
// to need.
std::optional<BudgetRefuter::Promising> BudgetRefuter::promising(const BoundGoal& goal, double bound,
                                                                 const Progress& progress,
                                                                 const PlannedSignals& signals,
                                                                 Selection& counterexample) const {
  constexpr double reserve_of_batches = 1.5;
  const SelectionBudget limit = goal.below(bound);
  const SignalTable& table = signals.table;
  const RunControl& control = rounds_.control();
  const Deadline deadline(rounds_.seconds_for(share_of_refutation, seconds_of_search));
  constexpr double reserves[] = {10.0, 7.0, 5.0, 3.5, 2.5, 1.7, 1.2, 0.8, 0.5, 0.3, 0.15};
  const double of_batch = Rounds::samples_per_batch(prepared_);
  const auto raised_by = [&](double errors) {
    return raised_table(table, *signals.matrix, errors, min_verifying_batches * of_batch);
  };
  // Labels that refute nothing with the smallest reserve refute nothing with a larger one. If the relaxation
  // refutes, exact searches for core rows, which take seconds for large stores, are not needed.
  const SignalTable smallest = raised_by(*std::rbegin(reserves));
  const bool is_relaxed = relaxed_cover(smallest, limit, deadline, control).is_refuted;
  // Leaves that stay open may be refuted although the whole is not.
  const bool has_leaves = !progress.open.empty();
  if (!is_relaxed && !has_leaves)
    if (CoreRows core = core_labels(smallest, goal, bound, deadline); !core.suffice) {
      counterexample = std::move(core.counterexample);
      return std::nullopt;
    }
  // Bisection: a smaller reserve closes all leaves that a larger one closes.
  const std::size_t leaves = std::min(max_leaves, max_columns_of_leaves / (table.columns() + 1));
  std::optional<Promising> best;
  for (std::size_t low = 0, high = std::size(reserves); low < high && !deadline.has_passed();) {
    // Where margins are wide, the largest reserve closes at once.
    const bool is_first = low == 0 && high == std::size(reserves);
    const std::size_t middle = is_first ? 0 : (low + high) / 2;
    const SignalTable raised = raised_by(reserves[middle]);
    const CoreRows core = is_relaxed ? CoreRows() : core_labels(raised, goal, bound, deadline);
    const std::vector<LabelId> labels =
        is_relaxed ? relaxed_cover(raised, limit, deadline, control).labels : core.rows;
    RefutationSearch search;
    search.counterexample = core.counterexample;
    if (!labels.empty() && (is_relaxed || core.suffice || has_leaves))
      search = find_refutation(raised, labels, limit, progress.open, leaves, deadline, control);
    if (!search.found) {
      if (!search.counterexample.empty()) counterexample = std::move(search.counterexample);
      low = middle + 1;
      continue;
    }
    high = middle;
    const double needed = needed_samples(*search.found, table, *signals.matrix, rounds_.level()) / of_batch;
    const double wanted = std::max<double>(progress.min_batches, reserve_of_batches * needed);
    if (wanted <= Rounds::max_batches) best = {std::move(*search.found), needed, wanted};
  }
  if (best) counterexample.clear();
  return best;
}

// Labels that by themselves require the bound, by an exact search.
CoreRows BudgetRefuter::core_labels(const SignalTable& raised, const BoundGoal& goal, double bound,
                                    const Deadline& deadline) const {
  PlaceOptions options;
  options.time_limit_s = std::min(5.0, 0.2 * deadline.seconds_left());
  options.step_limit = place_.step_limit;
  return core_rows(raised, goal, bound, options, rounds_.control());
}

}  // namespace shelfbeam
