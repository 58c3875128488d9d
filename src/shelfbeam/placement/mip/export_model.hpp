#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// The placement question as one MIP in the eliminated form: one binary column a transceiver (fixed at 1
/// where installed), one row a label, then one a mounting point with several options and one a pair, nothing
/// clipped or reduced.
///
/// A label's row is divided by its requirement, because solvers test rows with absolute tolerances:
/// - cooperative: sum_j M_ij / (gamma_i tau_i) T_j >= 1 - met_tolerance (3.9)
/// - non-cooperative: sum_j l_ij T_j >= 1 (3.2), >= 2 of a redundant question
/// - mounting point: the sum of T_j over its options <= 1
/// - a pair that must be kept apart: T_a + T_b <= 1
/// - redundant and cooperative, for every entry (i, j): sum over l != j of M_il / (gamma_i tau_i) T_l >= 1 -
///   met_tolerance. It holds whether j is chosen or not, so it needs no other variable.
///
/// For lexicographic questions the objective is the count; for weighted ones the whole sum, in the units of
/// the table.
/// Throws InputError where those last rows would have more than `largest_model` entries.
milp::Model placement_model(const SignalTable& table, const Question& question);

inline constexpr std::size_t largest_model = 20'000'000;

/// The same without the rows (i, j) of failures, which a search can add as they are needed (failure_row).
milp::Model model_without_failures(const SignalTable& table, const Question& question);

/// The row of label i when unit j fails.
milp::Row failure_row(const SignalTable& table, std::size_t label, std::uint32_t failed);

/// The costs of that objective: ones, or c_j^T plus the coefficient in the second objective.
std::vector<double> first_objective(const SignalTable& table, const Question& question);

}  // namespace shelfbeam
