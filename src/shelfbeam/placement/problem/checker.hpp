#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

/// The result of a selection, computed in double precision from the original table alone, without solver,
/// reduction or scaling.
struct Check {
  std::vector<double> signal;            ///< per label: received_signal, after the worst failure if redundant
  std::vector<std::uint32_t> serving;    ///< per label: chosen units with l_ij = 1
  std::vector<LabelId> unmet;            ///< missed labels, ascending
  std::vector<std::uint32_t> crowded;    ///< SignalTable::mounts with two or more chosen units, ascending
  std::vector<std::uint32_t> too_close;  ///< SignalTable::conflicts with both units chosen, ascending
  double transceiver_cost = 0;           ///< sum c_j^T T_j
  double objective = 0;                  ///< value of the second objective; 0 for count

  /// No two units are in conflict.
  bool allowed() const { return crowded.empty() && too_close.empty(); }
  /// The selection is feasible: every label is reached and no two units are in conflict.
  bool met() const { return unmet.empty() && allowed(); }
};

/// `selected`: columns of the table in any order; duplicates count once.
Check check_selection(const SignalTable& table, const PlacementProblem& problem,
                      std::span<const ColumnId> selected);

}  // namespace shelfbeam
