#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/plan/states/state_sample.hpp"

namespace shelfbeam {

/// The labels that decide on placements over states, with their signals from all candidates. It grows by the
/// labels that a placement misses; a bound from some labels holds for all of them.
class DecidingLabels {
 public:
  /// Begins with the labels that `start` reaches with little reserve in any state. `all`: the table of all
  /// labels. All references must outlive the object. Throws as `simulate_states`, as the other functions do.
  DecidingLabels(const StateSample& sample, const SignalTable& all, const PlacementProblem& problem,
                 std::span<const ColumnId> start);

  /// Begins without labels.
  DecidingLabels(const StateSample& sample, const SignalTable& all, const PlacementProblem& problem);

  const ScenarioTable& table() const { return table_; }
  /// Rows of the table, as labels of the shop.
  std::span<const LabelId> labels() const { return labels_; }
  std::size_t of_shop() const { return row_of_.size(); }
  /// The row of a label in the table. Precondition: it has one.
  LabelId row_of(LabelId label) const { return row_of_[label]; }
  bool has(LabelId label) const { return row_of_[label] != no_row; }
  /// The misses of all labels in the sampled states if `start` is mounted.
  const ScenarioMisses& misses_of_start() const { return misses_of_start_; }

  /// The misses of all labels in the sampled states.
  ScenarioMisses misses(std::span<const ColumnId> selected) const;
  /// Adds the labels that are not in the table and satisfy a test. Returns their number.
  template <class Test>
  std::size_t add_if(const Test& test) {
    std::vector<LabelId> added;
    for (std::uint32_t i = 0; i < row_of_.size(); ++i)
      if (!has(i) && test(i)) added.push_back(i);
    add(added);
    return added.size();
  }

 private:
  static constexpr std::uint32_t no_row = ~0U;

  void add(std::span<const LabelId> labels);
  // Labels of the table, and others by the signals that they receive.
  ScenarioMisses misses_with(std::span<const LabelId> others, std::span<const double> received,
                             std::span<const ColumnId> selected) const;

  const StateSample& sample_;
  const SignalTable& all_;
  const PlacementProblem& problem_;
  std::vector<LabelId> labels_, row_of_;
  ScenarioTable table_;
  ScenarioMisses misses_of_start_;
};

}  // namespace shelfbeam
