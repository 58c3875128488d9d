#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// The placement problem as a MIP in the eliminated form: one binary column per transceiver (fixed at 1 if
/// installed); rows for the labels, then the mounting points with several options, then the forbidden pairs.
/// Nothing is clipped or reduced. Label rows are divided by their requirement, because solvers test rows with
/// absolute tolerances:
/// - cooperative: sum_j M_ij / (gamma_i tau_i) T_j >= 1 - met_tolerance (3.9)
/// - non-cooperative: sum_j l_ij T_j >= 1 (3.2), >= 2 with unit failure
/// - mounting point: sum of T_j over its options <= 1
/// - forbidden pair: T_a + T_b <= 1
/// - cooperative with unit failure, for every entry (i, j): sum_{l != j} M_il / (gamma_i tau_i) T_l >= 1 -
///   met_tolerance. The row holds whether j is chosen or not, so it needs no further variable.
///
/// The objective is the count (lexicographic) or the whole sum (weighted), in the table's units of measure.
/// Throws InputError if the failure rows would have more than `largest_model` entries.
milp::Model placement_model(const SignalTable& table, const PlacementProblem& problem);

inline constexpr std::size_t largest_model = 20'000'000;

/// The same without the failure rows (i, j), which a search adds as required (failure_row).
milp::Model model_without_failures(const detail::Instance& instance);

/// The row of label i when unit j fails.
milp::Row failure_row(const SignalTable& table, std::size_t label, std::uint32_t failed);

}  // namespace shelfbeam
