#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// What a selection does, computed in double precision from the original table alone: no solver, no
/// reduction, no scaling.
struct Check {
  std::vector<double> signal;            ///< per label: received_signal, after the worst failure if redundant
  std::vector<std::uint32_t> serving;    ///< per label: chosen units that reach it alone (l_ij = 1)
  std::vector<std::uint32_t> unmet;      ///< labels that are not met, ascending
  std::vector<std::uint32_t> crowded;    ///< SignalTable::mounts that would hold two units or more, ascending
  std::vector<std::uint32_t> too_close;  ///< SignalTable::apart of which both are chosen, ascending
  double transceiver_cost = 0;           ///< sum c_j^T T_j
  double objective = 0;                  ///< value of the question's second objective; 0 for count

  /// No two units exclude one another.
  bool allowed() const { return crowded.empty() && too_close.empty(); }
  /// The selection is an answer: every label is met, and no two units exclude one another.
  bool met() const { return unmet.empty() && allowed(); }
};

/// `selected` are columns of the table in any order; one that is named twice counts once.
Check check_selection(const SignalTable& table, const Question& question,
                      std::span<const std::uint32_t> selected);

}  // namespace shelfbeam
