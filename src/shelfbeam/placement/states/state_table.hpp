#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The signals of all labels in some states of a shop.
struct StateTable {
  SignalTable table;  ///< labels, columns, mounting points and conflicts; entries: the means of the states
  std::size_t states = 0;
  std::vector<float> signal;  ///< by label, state and column

  std::span<const float> row(std::size_t label, std::size_t state) const {
    return std::span(signal).subspan((label * states + state) * table.columns(), table.columns());
  }
};

/// The table of a matrix with states. `table` is its SignalTable with all constraints.
StateTable make_state_table(const SignalMatrix& matrix, SignalTable table);

/// received_signal (placement_problem.hpp) of a label in one state, from the chosen columns, ascending.
double received_signal(std::span<const float> row, std::span<const std::uint32_t> selected,
                       const PlacementProblem& problem);

/// The number of states in which each label is missed, from the signals alone.
std::vector<std::uint32_t> misses_of(const StateTable& states, const PlacementProblem& problem,
                                     std::span<const std::uint32_t> selected);

/// The largest number of misses in `states` that a label of this availability keeps to: the whole part of
/// (1 - availability) states.
std::uint32_t allowed_misses(double availability, std::size_t states);

/// The same widened, so that a label which is reached with at least this probability in each of independent
/// states exceeds it with a probability of at most `level`.
std::uint32_t widened_misses(double availability, std::size_t states, double level);

}  // namespace shelfbeam
