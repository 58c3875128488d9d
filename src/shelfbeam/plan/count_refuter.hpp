#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/tested_refutation.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// Proves bounds on the count where signals add up: refutations of all selections of fewer units, made on the
/// matrix and tested with independent batches. Leaves that a test leaves open are split and tested again.
class CountRefuter {
 public:
  CountRefuter(const PreparedScene& prepared, const PlaceOptions& place, const RunControl& control)
      : prepared_(prepared), place_(place), control_(control) {}

  struct Attempt {
    bool is_tested = false;  ///< otherwise no refutation was found, or its test exceeds the budget
    bool is_proven = false;  ///< every feasible selection has at least this count
    std::size_t labels = 0;  ///< of the refutation
    std::uint32_t batches = 0;
    std::vector<ValidationRow> fresh;
    double cost = 0;                            ///< of a test that exceeds the budget
    std::vector<std::uint32_t> counterexample;  ///< fewer units that may reach all labels
  };

  /// Tests whether fewer than `count` units cannot reach all labels. `cost`: of a batch of a label, in the
  /// budget's unit of measure. Throws as `sample_batches`.
  Attempt attempt(std::size_t count, const SignalTable& table, const SignalMatrix& matrix, Rounds& rounds,
                  double level, double cost);

  /// After a change of the matrix, attempts that found no refutation may be repeated.
  void forget_failures() { failed_.clear(); }

 private:
  struct Progress {
    std::vector<Refutation::Leaf> open;  ///< empty: all selections
    std::uint32_t min_batches = min_verifying_batches;
  };
  struct Promising {
    Refutation refutation;
    std::uint32_t batches = 0;
  };
  std::optional<Promising> promising(const SelectionBudget& limit, const Progress& progress,
                                     const SignalTable& table, const SignalMatrix& matrix, double seconds,
                                     double level, std::vector<std::uint32_t>& counterexample) const;
  std::vector<std::uint32_t> core_labels(const SignalTable& raised, const SelectionBudget& limit,
                                         const Deadline& deadline) const;

  const PreparedScene& prepared_;
  const PlaceOptions& place_;
  const RunControl& control_;
  std::map<std::size_t, Progress> progress_;  ///< by count
  std::set<std::size_t> failed_;              ///< counts without a refutation on the present matrix
};

}  // namespace shelfbeam
