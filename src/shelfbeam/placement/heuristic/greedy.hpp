#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// A greedy selection that starts from the installed units; ascending. Each step adds the candidate with the
/// minimum cost per gain, ties to the lowest index:
///
///   j = argmin c(S_j) / gain_j,   c(S_j) = 1 + coefficient of T_j        (lexicographic)
///                                 c(S_j) = c_j^T + coefficient of T_j    (weighted)
///
/// with the coefficients of the second objective, links included, and a_ij = min(1, M_ij / (gamma_i tau_i)):
/// - non-cooperative (algorithm 1): gain_j = number of labels newly reached. The sum of c(S_j) is at most
///   H(m) times the minimum (Chvatal 1979).
/// - cooperative: gain_j = sum_i min(r_i, a_ij) over missed labels, r_i = 1 - S_i / (gamma_i tau_i). At most
///   1 + ln(G / g) times the minimum, G the gain of all candidates together, g the lack before the last step
///   (Wolsey, Combinatorica 2, 1982).
/// - non-cooperative, unit failure: gain_j = number of labels that j reaches and fewer than two chosen units
///   reach. H(m) again.
/// - cooperative, unit failure: with b_i the largest chosen a_ij and r_i the lack after the failure of the
///   strongest unit, gain_j = sum_i min(a_ij, r_i + max(0, a_ij - b_i)) over missed labels. It is positive
///   for any unit with a signal at a missed label. No guarantee.
///
/// If conflicts block all candidates, a unit is exchanged for a candidate that only this unit blocks, as long
/// as that reduces the total lack. Conflicts void the guarantees, and labels may stay missed: the caller
/// checks.
///
/// When `effort` is over, the remaining labels are reached in one pass over the table, each by the units that
/// it receives best, without regard to costs.
Selection greedy_selection(const detail::Instance& instance, const detail::Effort& effort = {},
                           const RunControl& control = {});

/// The same units in the order of their addition, the installed ones first. Each gain and lack counts by the
/// weight of its label (empty: 1); labels of weight 0 play no part. A unit never conflicts with an earlier
/// one.
std::vector<ColumnId> greedy_order(const detail::Instance& instance, std::span<const double> weight,
                                   const detail::Effort& effort, const RunControl& control);

}  // namespace shelfbeam
