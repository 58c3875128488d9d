#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/placement/scenarios/misses.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The signals of some labels in scenarios: sampled states of a shop that changes. A selection may miss
/// labels in some of them (MissAllowance), but in none of the scenarios of a SignalTable.
struct ScenarioTable {
  SignalTable table;  ///< labels, columns, mounting points and conflicts, without entries
  std::size_t count = 0;
  std::vector<float> signal;  ///< by column, label and scenario
  std::vector<float> error;   ///< standard errors in the same order; empty: exact signals

  std::size_t at(std::size_t column, std::size_t label, std::size_t scenario) const {
    return (column * table.rows() + label) * count + scenario;
  }
  /// The signals of one label from one column in all scenarios.
  std::span<const float> of(ColumnId column, std::size_t label) const {
    return std::span(signal).subspan(at(column, label, 0), count);
  }
};

/// A table of some of the labels of `all`, in the given order, with signals of 0. Rows whose labels `before`
/// has at the same position keep their signals.
ScenarioTable make_scenario_table(const SignalTable& all, std::span<const LabelId> labels,
                                  std::size_t scenarios, const ScenarioTable& before = {});

/// Sets the signals of the rows from `first` on in one scenario.
void set_scenario(ScenarioTable& scenarios, std::size_t scenario, std::size_t first,
                  const SignalLayer& signals);

/// All signals raised by a number of standard errors, then taken as exact.
ScenarioTable raised(const ScenarioTable& scenarios, double errors);

/// What a label receives in every scenario from the chosen columns, ascending.
std::vector<ReceivedSignal> received_signals(const ScenarioTable& scenarios, const PlacementProblem& problem,
                                             std::size_t label, std::span<const ColumnId> selected);

/// Calls visit(label, scenario, received) for those labels in scenarios that receive less than `enough` times
/// their requirement from the chosen columns, label by label.
template <class Visit>
void for_each_weak(const ScenarioTable& scenarios, const PlacementProblem& problem,
                   std::span<const ColumnId> selected, double enough, const Visit& visit) {
  for (std::uint32_t i = 0; i < scenarios.table.rows(); ++i) {
    const double requirement = enough * requirement_of(scenarios.table.labels[i], problem.model);
    const std::vector<ReceivedSignal> received = received_signals(scenarios, problem, i, selected);
    for (std::uint32_t s = 0; s < received.size(); ++s)
      if (!is_met(received[s].value(), requirement)) visit(i, s, received[s]);
  }
}

/// The misses of a selection with `reserve` times all requirements, from the signals alone, without solver or
/// cuts.
ScenarioMisses misses_of(const ScenarioTable& scenarios, const PlacementProblem& problem,
                         std::span<const ColumnId> selected, double reserve = 1);

}  // namespace shelfbeam
