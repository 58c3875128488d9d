#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/placement/reduce/cover_matrix.hpp"

namespace shelfbeam::detail {

/// Divides rows sum_j a_ij T_j >= b_i, a_ij > 0, into connected parts of similar mass that share little:
/// halves by the second eigenvector of the rows' overlap (Fiedler 1973), and so on. Deterministic. Each part
/// is ascending.
std::vector<std::vector<std::uint32_t>> divided_rows(std::span<const milp::Row> rows, std::size_t columns,
                                                     std::span<const double> mass, std::size_t parts);

/// Parts of similar cost, where the cost of a row is the smallest share of its columns.
std::vector<std::vector<std::uint32_t>> divided_rows(const CoverMatrix& cover, std::size_t parts);

}  // namespace shelfbeam::detail
