#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/scenarios/scenario_table.hpp"

namespace shelfbeam {

/// Count or new spend of a selection, by the problem's combination.
double scenario_value(const ScenarioTable& scenarios, const PlacementProblem& problem,
                      std::span<const ColumnId> selected);

/// Adds units to selections, one at a time.
class ScenarioSearch {
 public:
  /// `scenarios`, `problem` and `allowance` must outlive the object. The time of `effort` limits each search.
  ScenarioSearch(const ScenarioTable& scenarios, const PlacementProblem& problem,
                 const MissAllowance& allowance, const detail::Effort& effort, const RunControl& control)
      : scenarios_(scenarios),
        problem_(problem),
        allowance_(allowance),
        effort_(effort),
        control_(control),
        mounts_(scenarios.table) {}

  /// Adds units until the allowance holds or no unit helps, then drops units that are not required. nullopt
  /// if that takes a value of `below` or more.
  std::optional<Selection> repaired(Selection selected, double below) const;
  /// The selection and the unit that helps most; unchanged if no unit helps. If misses do not decide, that is
  /// the unit with the largest signals at `labels`, as shares of at most 1 of their requirements.
  Selection with_another(Selection selected, std::span<const LabelId> labels = {}) const;

 private:
  // A label in a scenario that receives little.
  struct Weak {
    LabelId label;
    std::uint32_t scenario = 0;
    ReceivedSignal received;
  };
  // The first that differs counts: misses beyond the allowed ones; squares of the depths of all labels, in
  // how many scenarios they fall short of their requirement, and of some more; minus the sum of the new
  // unit's signals at some labels.
  using Rank = std::array<double, 3>;

  std::vector<Weak> weak_cases(std::span<const ColumnId> selected) const;
  Rank rank(const std::vector<Weak>& weak, std::optional<ColumnId> added,
            std::span<const LabelId> labels) const;
  bool can_join(ColumnId column, const Selection& selected) const;
  bool fits(const Selection& selected) const {
    return allowance_.excess(misses_of(scenarios_, problem_, selected)) == 0;
  }
  double value(const Selection& selected) const { return scenario_value(scenarios_, problem_, selected); }
  double price(ColumnId column) const;

  const ScenarioTable& scenarios_;
  const PlacementProblem& problem_;
  const MissAllowance& allowance_;
  detail::Effort effort_;
  RunControl control_;
  Mounts mounts_;
};

}  // namespace shelfbeam
