#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/plan/bound_goal.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/budget_refuter.hpp"
#include "shelfbeam/plan/rounds.hpp"

namespace shelfbeam {

/// Proves in rounds, with independent batches of all candidates, that every selection that reaches all labels
/// costs at least the goal, or less if that is too expensive to prove.
///
/// - Where signals add up, a refutation of all cheaper selections is tested (budget_refuter.hpp).
/// - Where one unit alone must reach a label (or two, if a unit may fail), the entries that count as too weak
///   are fixed beforehand. If a cheaper selection S* reaches all labels, it misses some label i by the fixed
///   entries, so that one of these, the link by which S* reaches i, is strong enough after all. This entry
///   does not depend on the batches: every limit has the whole level.
/// - Where signals add up and a unit may fail, a search on upper limits of entries proves the bound. It is
///   wrong only if a limit of the at most u units of S* is too low for one of the r labels: r u limits share
///   the level.
class BoundRounds {
 public:
  static constexpr std::size_t max_undecided = 64;  ///< labels that get more samples at once

  /// Bounds are written to `certificate`.
  BoundRounds(const PreparedScene& prepared, const PlaceOptions& place, Rounds& rounds,
              Certificate& certificate)
      : prepared_(prepared),
        place_(place),
        rounds_(rounds),
        certificate_(certificate),
        refuter_(prepared, place, rounds) {}

  /// Sets the goal: the bound of a placement with a selection on its table.
  void aim(const SignalTable& table, const Placement& placement);
  bool holds() const { return proven() >= goal_.value * (1 - 1e-9); }
  /// The goal is the count or the cost of the placement itself, or nothing is to be proven.
  bool is_tight() const { return goal_.value == 0 || goal_.value >= value_ * (1 - 1e-9); }

  /// Tests one bound, the largest that the budget allows. Returns whether it has sampled. Throws as
  /// `sample_batches`.
  bool prove(const PlannedSignals& signals);

  /// Lists as missed the first unreachable labels of a placement whose upper limits leave them out of reach
  /// of all candidates together. Returns whether it has sampled.
  bool prove_unreachable(const SignalTable& table, const Placement& placement);

  /// Independent batches of all candidates that no test needs any more.
  std::vector<ValidationRow> take_fresh();
  /// A cheaper selection that may reach all labels; empty if the last test met none.
  Selection take_counterexample();
  /// After a change of the matrix.
  void forget_failures() { refuter_.forget_failures(); }

  /// The reason why the bound does not hold, if it is known.
  const std::optional<EndReason>& obstacle() const { return obstacle_; }

 private:
  double proven() const;
  void raise(double bound, std::size_t labels);
  void set_obstacle(double bound, double cost);
  bool refute(double bound, const PlannedSignals& signals, double share);
  bool prove_by_entries(const PlannedSignals& signals);
  CoreRows promising_rows(const PlannedSignals& signals);
  SignalTable expected_table(const PlannedSignals& signals, std::size_t rows, std::uint32_t batches) const;
  double cost_of(std::size_t labels) const;
  std::optional<SignalTable> upper_limits(const SignalTable& table, const std::vector<LabelId>& labels,
                                          const LimitCounts& counts);
  LimitCounts counts(std::size_t rows, std::size_t columns) const;

  const PreparedScene& prepared_;
  const PlaceOptions& place_;
  Rounds& rounds_;
  Certificate& certificate_;
  BoundGoal goal_;
  double value_ = 0;  ///< count or cost of the placement
  BudgetRefuter refuter_;
  std::uint32_t batches_ = min_verifying_batches;  ///< of the next test of entries
  std::size_t rows_ = max_undecided;               ///< expected maximum number of core rows
  std::optional<EndReason> obstacle_;
  std::vector<ValidationRow> fresh_;
  Selection counterexample_;
};

}  // namespace shelfbeam
