#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

/// Proven upper bounds on the weight of the labels that at most k units, installed units included, can reach.
/// For any multipliers y_i in [0, 1]
///
///   reached <= sum_i w_i (1 - y_i) + sum of the k largest c_j,   c_j = sum_i w_i y_i b_ij,
///
/// where every reached label satisfies sum_j b_ij T_j >= 1 (docs/methods/placement.md, "Max coverage"). Every
/// y gives a bound; subgradient steps search for good ones. Bounds are sums in double precision over entries
/// that are rounded up, so they hold for any steps.
class CoverageBound {
 public:
  using Clock = std::chrono::steady_clock;

  /// For selections of at most `max_units` units, at least the number installed.
  CoverageBound(const SignalTable& table, const PlacementProblem& problem,
                const detail::LabelWeights& weights, std::size_t max_units);

  /// Upper bound on the weight that `units` <= max_units can reach; does not decrease with `units`.
  double weight(std::size_t units) const;

  /// Takes about `steps` subgradient steps for `units`, starting from the multipliers of the last ones. Ends
  /// early if the bound falls to `reached`, which is known to be possible, or at `until`.
  void improve(std::size_t units, double reached, std::size_t steps, const RunControl& control,
               Clock::time_point until = Clock::time_point::max());

  /// Matrix entries that one step examines.
  std::size_t entries() const { return entries_.size(); }

 private:
  struct Entry {
    std::uint32_t column = 0;
    float share = 0;  ///< a_ij, rounded up
  };
  struct Candidate {
    std::uint32_t column = 0;
    double value = 0;
  };

  /// Bounds of several kinds, by the part d of every share that is omitted.
  struct Kind {
    double omitted = 0;  ///< k d
    std::vector<double> multiplier;
  };

  void improve(Kind& kind, std::size_t units, double reached, std::size_t steps, const RunControl& control,
               Clock::time_point until);
  double lifted(const Kind& kind, std::size_t units, std::size_t label, const Entry& entry) const;
  std::vector<Candidate> best_candidates(const std::vector<double>& value) const;
  double evaluate(const Kind& kind, std::size_t units, std::vector<bool>& counted);

  const detail::LabelWeights& weights_;
  Mounts mounts_;
  std::vector<bool> installed_;
  std::size_t installed_count_ = 0;
  bool redundant_;
  std::vector<std::size_t> row_begin_ = {0};  ///< of the labels that can be reached and weigh anything
  std::vector<Entry> entries_;
  std::vector<double> weight_;         ///< w_i
  std::vector<double> min_share_sum_;  ///< R_i, lower bound on the shares of a reached label
  std::vector<Kind> kinds_;
  std::vector<double> best_;  ///< per number of units
};

}  // namespace shelfbeam
