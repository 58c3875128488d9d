#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/scenarios/cut_proof.hpp"
#include "shelfbeam/placement/scenarios/scenario_table.hpp"

namespace shelfbeam {

/// The cuts of place_over_scenarios.hpp, as rows of a table with requirement 1, which hold for sums of all
/// units of a selection, with unit failure as well.
///
/// For selections of at most K units a cut may use smaller shares: parts below s give a case at most s K in
/// all, so a case that is met has
///
///   sum_j min(1, max(0, a_j - s) / (1 - s K)) x_j >= 1,   a_j the share of unit j.
///
/// Every cut has passed its judge (cut_proof.hpp).
class ScenarioCuts {
 public:
  /// Begins with one cut per label, over all scenarios. The arguments must outlive the object.
  ScenarioCuts(const ScenarioTable& scenarios, const PlacementProblem& problem,
               const MissAllowance& allowance);

  const SignalTable& table() const { return table_; }
  std::size_t size() const { return table_.rows(); }

  /// Adds cuts that a selection violates, if it misses labels too often. Returns their number.
  std::size_t add(std::span<const ColumnId> selected, const ScenarioMisses& misses);
  /// Adds the cuts of labels that a solution of a linear program violates most, for selections of at most
  /// `max_units` units. Labels that are not examined in time give none. Returns the number of
  /// cuts; apart from the time, it does not depend on the threads.
  std::size_t add_violated(std::span<const double> x, std::size_t max_units, const detail::Effort& effort,
                           const RunControl& control);

 private:
  /// With unit failure without its strongest unit.
  struct Case : CutProof::Case {
    double largest = 0;   ///< received from the failed unit
    double received = 0;  ///< from the others, as a share of the requirement

    void add(ColumnId column, double share, bool fails);
  };
  /// The parts of shares that count.
  struct Counted {
    double above = 0, lack = 1, units = 0;  ///< s, 1 - s K, and K
    double of(double share) const;
  };
  /// A unit with its value, 1 in a selection.
  struct Part {
    ColumnId column;
    double x = 1;
  };
  struct Cut {
    double left_side = 1;
    std::vector<double> shares = {};
    CutProof proof = {};
  };

  double share(const Case& at, ColumnId column) const;
  double mean_of_largest(std::span<const Case> cases, std::size_t kept, ColumnId column,
                         const Counted& counted, std::vector<double>& shares) const;
  Cut cut_over(std::span<const Case> cases, std::size_t allowed, const Counted& counted) const;
  std::vector<Case> cases_of(LabelId label, std::span<const Part> parts, const Counted& counted) const;
  void lower(Cut& best, std::span<const Case> cases, std::size_t allowed, std::span<const Part> parts,
             const Counted& counted) const;
  Cut most_violated(LabelId label, std::span<const Part> parts, std::size_t max_units) const;
  Cut cover_cut(std::vector<Case> cases, std::size_t allowed, bool by_scenario,
                std::span<const Part> parts) const;
  void add_cuts(std::vector<Case> cases, std::size_t allowed, bool by_scenario, std::span<const Part> parts);
  void append(Cut cut);

  const ScenarioTable& scenarios_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  SignalTable table_;
};

}  // namespace shelfbeam
