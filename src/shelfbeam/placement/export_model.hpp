#pragma once

#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/placement/instance.hpp"

namespace shelfbeam {

/// The placement question as one MIP in the eliminated form: one binary column a transceiver (fixed at 1
/// where installed), one row a label, then one row a mounting point with several options, nothing clipped or
/// reduced.
///
/// A label's row is divided by its requirement, because solvers test rows with absolute tolerances:
/// - cooperative: sum_j M_ij / (gamma_i tau_i) T_j >= 1 - met_tolerance (3.9)
/// - non-cooperative: sum_j l_ij T_j >= 1 (3.2)
/// - mounting point: the sum of T_j over its options <= 1
///
/// For lexicographic questions the objective is the count; for weighted ones the whole sum, in the units of
/// the table.
milp::Model placement_model(const SignalTable& table, const Question& question);

/// The costs of that objective: ones, or c_j^T plus the coefficient in the second objective.
std::vector<double> first_objective(const SignalTable& table, const Question& question);

}  // namespace shelfbeam
