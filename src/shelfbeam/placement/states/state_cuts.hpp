#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/states/state_table.hpp"

namespace shelfbeam {

/// The cuts of place_over_states.hpp, as rows of a table with requirement 1.
class StateCuts {
 public:
  /// Begins with one cut per label, over all states.
  StateCuts(const StateTable& states, const PlacementProblem& problem, const MissAllowance& allowance);

  const SignalTable& table() const { return table_; }
  std::size_t size() const { return table_.rows(); }

  /// Adds cuts that a selection violates, if it misses labels too often. Returns their number.
  std::size_t add(std::span<const std::uint32_t> selected, const StateMisses& misses);

 private:
  /// A label in a state.
  struct Case {
    std::uint32_t label = 0, state = 0;
    double received = 0;  ///< from the selection, as a share of the requirement
  };

  double requirement(std::size_t label) const {
    return requirement_of(states_.table.labels[label], problem_.model);
  }
  double share(const Case& at, std::uint32_t column) const;
  std::vector<double> mean_of_largest(std::span<const Case> cases, std::size_t kept) const;
  double left_side(const std::vector<double>& shares, std::span<const std::uint32_t> selected) const;
  std::vector<Case> cases_of(std::size_t label, std::span<const std::uint32_t> selected) const;
  void add_cuts(std::vector<Case> cases, std::size_t allowed, bool by_state,
                std::span<const std::uint32_t> selected);
  std::vector<double> violated_cut(std::span<const Case> cases, std::size_t allowed,
                                   std::span<const std::uint32_t> selected) const;
  std::vector<double> cover_cut(std::vector<Case> cases, std::size_t allowed, bool by_state,
                                std::span<const std::uint32_t> selected) const;
  void append(const std::vector<double>& shares);

  const StateTable& states_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  SignalTable table_;
};

}  // namespace shelfbeam
