#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/plan/bound_goal.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/tested_refutation.hpp"

namespace shelfbeam {

/// Proves bounds on the cost where signals add up: refutations of all cheaper selections, made on the matrix
/// and tested with independent batches. Leaves that a test leaves open are split and tested again.
class BudgetRefuter {
 public:
  BudgetRefuter(const PreparedScene& prepared, const PlaceOptions& place, Rounds& rounds)
      : prepared_(prepared), place_(place), rounds_(rounds) {}

  struct Attempt {
    bool is_tested = false;  ///< otherwise no refutation was found, or its test exceeds the budget
    bool is_proven = false;  ///< every feasible selection costs at least the bound
    std::size_t labels = 0;  ///< of the refutation
    std::vector<ValidationRow> fresh;
    double cost = 0;           ///< of a test that exceeds the budget
    Selection counterexample;  ///< a cheaper selection that may reach all labels
  };

  /// Tests whether no selection that costs less than `bound` reaches all labels. `share`: of the rest of the
  /// budget that the test may take. A test that exceeds a share below 1 may be attempted again. Throws as
  /// `sample_batches`.
  Attempt attempt(const BoundGoal& goal, double bound, const PlannedSignals& signals, double share);

  /// After a change of the matrix, attempts that found no refutation may be repeated, a few times.
  void forget_failures();

 private:
  struct Promising {
    Refutation refutation;
    double needed = 0, wanted = 0;  ///< batches, without and with a reserve
    bool is_repeat = false;         ///< the open leaves of a test with their own weights, to be tested again
  };
  struct Progress {
    std::vector<Refutation::Leaf> open;  ///< empty: all selections
    std::uint32_t min_batches = min_verifying_batches;
    bool has_failed = false;  ///< there is no refutation on the present matrix
    int failures = 0;
    std::optional<Promising> pending;  ///< waits for its test
  };
  std::optional<Promising> promising(const BoundGoal& goal, double bound, const Progress& progress,
                                     const PlannedSignals& signals, Selection& counterexample) const;
  CoreRows core_labels(const SignalTable& raised, const BoundGoal& goal, double bound,
                       const Deadline& deadline) const;

  const PreparedScene& prepared_;
  const PlaceOptions& place_;
  Rounds& rounds_;
  std::map<double, Progress> progress_;  ///< by bound
};

}  // namespace shelfbeam
