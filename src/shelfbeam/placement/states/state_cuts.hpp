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
  StateCuts(const StateTable& states, const PlacementProblem& problem,
            std::span<const std::uint32_t> allowed);

  const SignalTable& table() const { return table_; }
  std::size_t size() const { return table_.rows(); }

  /// Adds cuts that a selection violates, for labels that it misses too often. Returns their number.
  std::size_t add(std::span<const std::uint32_t> selected, const std::vector<std::uint32_t>& misses);

 private:
  double share(std::size_t label, std::size_t state, std::uint32_t column) const;
  std::vector<double> mean_of_largest(std::size_t label, std::span<const std::uint32_t> order) const;
  double left_side(const std::vector<double>& shares, std::span<const std::uint32_t> selected) const;
  std::vector<double> violated_cut(std::size_t label, std::span<const std::uint32_t> selected) const;
  std::vector<double> cover_cut(std::size_t label, std::span<const std::uint32_t> selected) const;
  void append(std::size_t label, const std::vector<double>& shares);

  const StateTable& states_;
  const PlacementProblem& problem_;
  std::span<const std::uint32_t> allowed_;
  SignalTable table_;
};

}  // namespace shelfbeam
