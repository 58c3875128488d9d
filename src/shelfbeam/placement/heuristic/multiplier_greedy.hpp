#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/placement/bound/sparse_rows.hpp"

namespace shelfbeam::detail {

/// A selection that meets the rows, chosen by multipliers y (Caprara, Fischetti and Toth, Oper. Res. 47,
/// 1999), as columns of the table with the chosen ones of `rows`, ascending; empty if some row stays short.
/// With the lack r_i of row i, each step adds the column of the core with the smallest score
///
///   mu_j = sum_i min(a_ij, r_i),   gamma_j = c_j - sum_i y_i min(a_ij, r_i),
///   gamma_j / mu_j if gamma_j > 0, otherwise gamma_j mu_j.
///
/// Columns that turn out redundant are removed, the most expensive first. Conflicts other than those of one
/// mounting point are ignored: the caller checks.
Selection multiplier_greedy(const SparseRows& rows, std::span<const double> y,
                            std::span<const std::uint32_t> core);

}  // namespace shelfbeam::detail
