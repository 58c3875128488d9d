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

/// The signals of all labels in some states of a shop.
struct StateTable {
  SignalTable table;  ///< labels, columns, mounting points and conflicts; entries: the means of the states
  std::size_t states = 0;
  std::vector<float> signal;  ///< by column, label and state

  /// The signals of one label from one column in all states.
  std::span<const float> of(std::uint32_t column, std::size_t label) const {
    return std::span(signal).subspan((column * table.rows() + label) * states, states);
  }
};

/// The table of a matrix with states. `table` is its SignalTable with all constraints. `errors`: standard
/// errors by which all signals are raised.
StateTable make_state_table(const SignalMatrix& matrix, SignalTable table, double errors = 0);

/// received_signal (placement_problem.hpp) of a label in every state, from the chosen columns, ascending.
std::vector<double> received_signals(const StateTable& states, const PlacementProblem& problem,
                                     std::size_t label, std::span<const std::uint32_t> selected);

/// The misses of a selection, from the signals alone, without solver or cuts.
StateMisses misses_of(const StateTable& states, const PlacementProblem& problem,
                      std::span<const std::uint32_t> selected);

}  // namespace shelfbeam
