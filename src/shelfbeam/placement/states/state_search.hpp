#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/states/state_table.hpp"

namespace shelfbeam {

/// Count or new spend of a selection, by the problem's combination.
double state_value(const StateTable& states, const PlacementProblem& problem,
                   std::span<const std::uint32_t> selected);

/// Local search for selections that miss labels in few states.
class StateSearch {
 public:
  using Selection = std::vector<std::uint32_t>;  ///< ascending

  /// All references must outlive the object. `is_over` ends a search early.
  StateSearch(const StateTable& states, const PlacementProblem& problem, const MissAllowance& allowance,
              std::function<bool()> is_over)
      : states_(states),
        problem_(problem),
        allowance_(allowance),
        is_over_(std::move(is_over)),
        mounts_(states.table) {}

  bool fits(const StateMisses& misses) const { return allowance_.excess(misses) == 0; }

  /// Adds units until the allowance holds, then drops units that are not required. nullopt if that takes a
  /// value of `below` or more.
  std::optional<Selection> repaired(Selection selected, double below) const;
  /// Exchanges units at the same value or less as long as labels are missed less often or less nearly:
  /// stopping at the first selection that fits the states would overfit them.
  Selection spread(Selection selected) const;
  /// The selection and the unit that helps most; unchanged if no unit helps.
  Selection with_another(Selection selected) const;
  /// The selection and the unit with the largest signals at some labels, as shares of at most 1 of their
  /// requirements; unchanged if no unit that can join has any.
  Selection with_strongest(Selection selected, std::span<const std::uint32_t> labels) const;

 private:
  // Misses beyond the allowed ones, then the squares of the depths of all labels: in how many states they
  // fall short of their requirement, and of some more.
  struct Rank {
    std::uint64_t excess = 0;
    double depth = 0;
    bool operator<(const Rank& other) const {
      return excess < other.excess || (excess == other.excess && depth < other.depth);
    }
  };
  // A label with the states in which it receives little.
  struct Weak {
    std::uint32_t label = 0;
    std::vector<std::uint32_t> states;
    std::vector<ReceivedSignal> received;
  };

  std::vector<Weak> weak_labels(std::span<const std::uint32_t> selected) const;
  Rank rank(const std::vector<Weak>& weak, std::optional<std::uint32_t> added) const;
  Rank rank_of(std::span<const std::uint32_t> selected) const { return rank(weak_labels(selected), {}); }
  bool can_join(std::uint32_t column, const Selection& selected) const;
  bool is_installed(std::uint32_t column) const { return states_.table.transceivers[column].installed; }
  double value(const Selection& selected) const { return state_value(states_, problem_, selected); }
  double price(std::uint32_t column) const;

  const StateTable& states_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  std::function<bool()> is_over_;
  Mounts mounts_;
};

}  // namespace shelfbeam
