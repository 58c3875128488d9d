#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/plan/bound_goal.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/tested_refutation.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Proves bounds on the cost where signals add up: refutations of all cheaper selections, made on the matrix
/// and tested with independent batches. Leaves that a test leaves open are split and tested again.
class BudgetRefuter {
 public:
  BudgetRefuter(const PreparedScene& prepared, const PlaceOptions& place, const RunControl& control)
      : prepared_(prepared), place_(place), control_(control) {}

  struct Attempt {
    bool is_tested = false;  ///< otherwise no refutation was found, or its test exceeds the budget
    bool is_proven = false;  ///< every feasible selection costs at least the bound
    std::size_t labels = 0;  ///< of the refutation
    std::uint32_t batches = 0;
    std::vector<ValidationRow> fresh;
    double begun = 0;                           ///< Rounds::spent before the test
    double cost = 0;                            ///< of a test that exceeds the budget
    std::vector<std::uint32_t> counterexample;  ///< a cheaper selection that may reach all labels
  };

  /// Tests whether no selection that costs less than `bound` reaches all labels. `cost`: of a batch of a
  /// label, in the budget's unit of measure. `share`: of the rest of the budget that the test may take. A
  /// test that exceeds a share below 1 may be attempted again. Throws as `sample_batches`.
  Attempt attempt(const BoundGoal& goal, double bound, const SignalTable& table, const SignalMatrix& matrix,
                  Rounds& rounds, double level, double cost, double share);

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
  std::optional<Promising> promising(const SelectionBudget& limit, const BoundGoal& goal, double bound,
                                     const Progress& progress, const SignalTable& table,
                                     const SignalMatrix& matrix, double seconds, double level,
                                     std::vector<std::uint32_t>& counterexample) const;
  CoreRows core_labels(const SignalTable& raised, const BoundGoal& goal, double bound,
                       const Deadline& deadline) const;

  const PreparedScene& prepared_;
  const PlaceOptions& place_;
  const RunControl& control_;
  std::map<double, Progress> progress_;  ///< by bound
};

}  // namespace shelfbeam
