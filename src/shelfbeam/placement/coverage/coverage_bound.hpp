#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

/// Proven bounds of how many labels a number of units can reach: no selection of at most k units, installed
/// ones included, meets more. For any multipliers y_i in [0, 1]
///
///   reached <= sum_i (1 - y_i) + the largest sum over k units of c_j,  c_j = sum_i y_i b_ij
///
/// where a label that is met by k units has sum_j b_ij T_j >= 1 (docs/methods/placement.md). Every y gives a
/// bound; subgradient steps look for good ones. Whatever they find, bounds are sums in double precision over
/// entries that were rounded up.
class ReachBound {
 public:
  using Clock = std::chrono::steady_clock;

  /// For selections of at most `most_units`, no fewer than are installed.
  ReachBound(const SignalTable& table, const Question& question, std::size_t most_units);

  /// At most so many labels are reached by `units` <= most_units; does not fall with `units`.
  std::size_t labels(std::size_t units) const;

  /// Takes about so many steps towards a better bound for `units`, from where the last ones ended; ends
  /// early where it is down to `reached`, which is known to be possible, and where `until` comes.
  void improve(std::size_t units, std::size_t reached, std::size_t steps, const RunControl& control,
               Clock::time_point until = Clock::time_point::max());

  /// What one step has to look at.
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

  /// Bounds are of several kinds, by how much of each share is left out (docs/methods/placement.md).
  struct Kind {
    double left_out = 0;  ///< k d
    std::vector<double> multiplier;
  };

  void improve(Kind& kind, std::size_t units, std::size_t reached, std::size_t steps,
               const RunControl& control, Clock::time_point until);
  double lifted(const Kind& kind, std::size_t units, std::size_t label, const Entry& entry) const;
  std::vector<Candidate> best_candidates(const std::vector<double>& value) const;
  double evaluate(const Kind& kind, std::size_t units, std::vector<bool>& counted);

  Mounts mounts_;
  std::vector<bool> installed_;
  std::size_t installed_count_ = 0;
  bool redundant_;
  std::vector<std::size_t> row_begin_ = {0};  ///< of the labels that can be met at all
  std::vector<Entry> entries_;
  std::vector<double> together_;  ///< what the shares of a met label add up to at least
  std::vector<Kind> kinds_;
  std::vector<double> best_;  ///< per number of units
};

}  // namespace shelfbeam
