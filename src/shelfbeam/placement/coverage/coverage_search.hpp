#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam::detail {

/// Looks for selections of few units that reach many labels. Starts with the installed units, never breaks
/// what excludes what, and is done in the order of columns, so that the same question has the same answer.
class ReachSearch {
 public:
  ReachSearch(const SignalTable& table, const Question& question);

  /// Takes up a selection that holds the installed units.
  void start(const std::vector<std::uint32_t>& selected);

  /// Leaves out the unit without which fewest labels are missed; false where all are installed.
  bool drop();
  /// Exchanges units for others, adds up to `most_units` and at last leaves out those that reach nothing,
  /// as long as it helps, no more than about `work` entries have been looked at, and `until` has not come.
  void improve(std::size_t most_units, std::size_t work, const RunControl& control,
               std::chrono::steady_clock::time_point until);

  std::vector<std::uint32_t> selected() const;
  std::size_t count() const { return count_; }

 private:
  enum class Aim {
    what_is_lacking,  ///< as the greedy method: also what brings labels nearer
    labels            ///< labels that become met, then the same
  };

  struct Gains {
    std::vector<std::size_t> labels;  ///< per column: labels that become met
    std::vector<double> lacking;      ///< per column: how much less is lacking
    std::size_t reached = 0;          ///< labels, without an addition
    double lacks = 0;                 ///< without an addition
  };
  struct Choice {
    std::uint32_t column = 0;
    std::size_t labels = 0;
    double lacking = 0;
  };

  Gains gains(std::optional<std::uint32_t> without);
  std::optional<Choice> best(const Gains& gains, std::optional<std::uint32_t> without, Aim aim) const;
  bool exchange(std::uint32_t out);
  double share(std::size_t label, const SignalEntry& entry) const {
    return share_of(entry.signal, requirement_[label], question_);
  }
  void choose(std::uint32_t column, bool chosen);
  void look();

  const SignalTable& table_;
  const Question& question_;
  Mounts mounts_;
  std::vector<double> requirement_;
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> excluded_by_;  ///< how many of the chosen units exclude each column
  std::vector<LabelShares> shares_;         ///< per label, of the chosen units
  std::size_t count_ = 0, reached_ = 0;
  double lacks_ = 0;
  std::size_t work_ = 0;
};

}  // namespace shelfbeam::detail
