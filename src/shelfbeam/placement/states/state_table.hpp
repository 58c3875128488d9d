#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/placement/states/misses.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The signals of some labels in some states of a shop.
struct StateTable {
  SignalTable table;  ///< labels, columns, mounting points and conflicts, without entries
  std::size_t states = 0;
  std::vector<float> signal;  ///< by column, label and state
  std::vector<float> error;   ///< standard errors in the same order; empty: exact signals

  std::size_t at(std::size_t column, std::size_t label, std::size_t state) const {
    return (column * table.rows() + label) * states + state;
  }
  /// The signals of one label from one column in all states.
  std::span<const float> of(ColumnId column, std::size_t label) const {
    return std::span(signal).subspan(at(column, label, 0), states);
  }
};

/// A table of some of the labels of `all`, in the given order, with signals of 0. Rows whose labels `before`
/// has at the same position keep their signals.
StateTable make_state_table(const SignalTable& all, std::span<const std::uint32_t> labels, std::size_t states,
                            const StateTable& before = {});

/// Sets the signals of the rows from `first` on in one state.
void set_state(StateTable& states, std::size_t state, std::size_t first, const SignalLayer& signals);

/// All signals raised by a number of standard errors, then taken as exact.
StateTable raised(const StateTable& states, double errors);

/// What a label receives in every state from the chosen columns, ascending.
std::vector<ReceivedSignal> received_signals(const StateTable& states, const PlacementProblem& problem,
                                             std::size_t label, std::span<const ColumnId> selected);

/// Calls visit(label, state, received) for those labels in states that receive less than `enough` times their
/// requirement from the chosen columns, label by label.
template <class Visit>
void for_each_weak(const StateTable& states, const PlacementProblem& problem,
                   std::span<const ColumnId> selected, double enough, const Visit& visit) {
  for (std::uint32_t i = 0; i < states.table.rows(); ++i) {
    const double requirement = enough * requirement_of(states.table.labels[i], problem.model);
    const std::vector<ReceivedSignal> received = received_signals(states, problem, i, selected);
    for (std::uint32_t s = 0; s < received.size(); ++s)
      if (!is_met(received[s].value(), requirement)) visit(i, s, received[s]);
  }
}

/// The misses of a selection with `reserve` times all requirements, from the signals alone, without solver or
/// cuts.
StateMisses misses_of(const StateTable& states, const PlacementProblem& problem,
                      std::span<const ColumnId> selected, double reserve = 1);

}  // namespace shelfbeam
