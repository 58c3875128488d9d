#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// A selection found greedily after the installed units; ascending. It meets every label where that is
/// possible and no candidates exclude one another. What a chosen unit excludes cannot be chosen; where labels
/// are left over therefore, a unit is exchanged for one that it alone excludes as long as what all labels
/// lack together becomes less by it, and the steps go on. Still, some may be left: the caller checks.
///
/// The cost c(S_j) of a unit is 1 (lexicographic) or c_j^T (weighted) plus its coefficient in the second
/// objective, links included. Each step takes the least cost per gain, ties to the lowest index:
/// - non-cooperative: gain = labels newly reached (algorithm 1). Costs at most H(m) times the least cost.
/// - cooperative: gain = sum_i min(r_i, M_ij / gamma_i tau_i) over the unmet labels, where r_i = 1 - S_i /
///   gamma_i tau_i is what label i still lacks (Wolsey, Combinatorica 2, 1982). Costs at most 1 + ln(G / g)
///   times the least cost, G the gain of all candidates together, g what was lacking before the last step.
/// Redundant questions: a label lacks a second unit that reaches it alone (non-cooperative; a step gains one
/// at each label, the guarantee is the same); cooperative, with a_ij = min(1, M_ij / gamma_i tau_i) and b_i
/// the largest of them chosen, gain = sum_i min(a_ij, r_i + max(0, a_ij - b_i)), where r_i is what label i
/// lacks when its strongest unit fails. This is positive for any unit that an unmet label hears; no
/// guarantee. All guarantees need candidates that do not exclude one another.
std::vector<std::uint32_t> greedy_selection(const SignalTable& table, const Question& question);

/// c(S_j) as above.
std::vector<double> greedy_costs(const SignalTable& table, const Question& question);

}  // namespace shelfbeam
