#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/bound/sparse_rows.hpp"
#include "shelfbeam/placement/problem/effort.hpp"

namespace shelfbeam::detail {

/// Multipliers of the rows of a SparseRows.
struct Multipliers {
  std::vector<double> y;        ///< one per row, not negative
  double bound = 0;             ///< L(y), not yet safe against rounding: dual_bound computes the proven one
  std::vector<double> reduced;  ///< r_j of every open column
  std::vector<double> x;        ///< average of recent solutions of the relaxation, one per open column
};

/// Multipliers, no r_j of which is negative: rows in order of length each take what their columns still have
/// (dual ascent), after a first share min_j c_j / (sum_i a_ij).
std::vector<double> ascended(const SparseRows& rows);

struct SubgradientOptions {
  std::size_t min_count = 0;  ///< units of every selection besides the chosen ones
  std::size_t max_count = std::numeric_limits<std::size_t>::max();
  double known = 0;  ///< cost of the best selection known
  double step = 1;   ///< costs are multiples of this: a bound above known - step ends the search
  Effort effort = {.steps = 600};
};

/// Maximises the Lagrangian dual
///
///   L(y) = sum_i y_i b_i + min over T of sum_j r_j T_j,   r_j = c_j - sum_i y_i a_ij,
///
/// by subgradient steps of Polyak's length (Beasley, Eur. J. Oper. Res. 31, 1987), deflected towards the last
/// step, with the column pricing of Caprara, Fischetti and Toth, Oper. Res. 47, 1999: steps see only the
/// core, the columns of small r_j, which is chosen anew now and then from all columns. T has at most one
/// option per mounting point. After 600 steps L is within 0.1 % of the LP bound on random covers.
Multipliers subgradient(const SparseRows& rows, std::vector<double> start, const SubgradientOptions& options,
                        const RunControl& control);

}  // namespace shelfbeam::detail
