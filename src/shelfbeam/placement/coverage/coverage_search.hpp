#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam::detail {

/// Search for selections of few units that reach labels of a large weight. Starts from the installed units,
/// respects conflicts, and processes columns in order, so equal problems give equal results.
class CoverageSearch {
 public:
  CoverageSearch(const SignalTable& table, const PlacementProblem& problem, const LabelWeights& weights);

  /// Replaces the selection by one that contains the installed units.
  void start(const std::vector<std::uint32_t>& selected);

  /// Removes the unit whose removal loses the least weight; false if all units are installed.
  bool drop();
  /// Adds units up to `max_units`, exchanges units, and finally removes units that reach no further label, as
  /// long as this improves the selection, within about `work` entries examined, and until `until`.
  void improve(std::size_t max_units, std::size_t work, const RunControl& control,
               std::chrono::steady_clock::time_point until);

  /// `improve`, then again and again after the removal of a few random units, as long as the limits allow;
  /// keeps the best selection. Random numbers are keyed by the repetition.
  void improve_repeatedly(std::size_t max_units, std::size_t work, const RunControl& control,
                          std::chrono::steady_clock::time_point until);

  std::vector<std::uint32_t> selected() const;
  std::size_t count() const { return count_; }
  double reached() const { return reached_; }  ///< weight of the reached labels

 private:
  enum class Aim {
    deficit,  ///< the greedy gain: reduction of the total lack
    weight    ///< weight newly reached, then the same
  };

  struct Gains {
    std::vector<double> weight;   ///< per column: weight newly reached
    std::vector<double> lacking;  ///< per column: reduction of the total lack
    double reached = 0;           ///< weight without an addition
    double lacks = 0;             ///< total lack, by weight, without an addition
  };
  struct Choice {
    std::uint32_t column = 0;
    double weight = 0;
    double lacking = 0;
  };

  Gains gains(std::optional<std::uint32_t> without);
  std::optional<Choice> best(const Gains& gains, std::optional<std::uint32_t> without, Aim aim) const;
  bool exchange(std::uint32_t out);
  void remove_some(std::uint64_t repetition);
  double share(std::size_t label, const SignalEntry& entry) const {
    return share_of(entry.signal, requirement_[label], problem_);
  }
  void choose(std::uint32_t column, bool chosen);
  void look();

  const SignalTable& table_;
  const PlacementProblem& problem_;
  const LabelWeights& weights_;
  Mounts mounts_;
  std::vector<double> requirement_;
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> blocked_by_;  ///< per column: chosen units in conflict with it
  std::vector<LabelShares> shares_;        ///< per label, of the chosen units
  std::size_t count_ = 0;
  double reached_ = 0, lacks_ = 0;
  std::size_t work_ = 0;
};

}  // namespace shelfbeam::detail
