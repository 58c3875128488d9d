#pragma once

#include <bit>
#include <cstdint>
#include <vector>

#include "shelfbeam/signal/tables/signal_table.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam::test {

/// Unicost set covers that are given by a formula and hard for their size: non-cooperative problems with
/// requirement 1. Known optima:
///
/// | instance | rows x columns | optimum | from |
/// | --- | --- | --- | --- |
/// | affine_lines(2), A9 | 12 x 9 | 5 | Fulkerson, Nemhauser, Trotter 1974 |
/// | affine_lines(3), A27 | 117 x 27 | 18 | Fulkerson, Nemhauser, Trotter 1974 |
/// | affine_lines(4), A81 | 1080 x 81 | 61 | Mannino, Sassano 1995 |
/// | cube_cycles(3), (4), (5) | 6 x 12, 24 x 32, 80 x 80 | 3, 8, 24 | edges less ex(Q_n, C_4) |
/// | cube_cycles(6), CYC06 | 240 x 192 | 60 | best published |
/// | cube_cycles(7), CYC07 | 672 x 448 | 144 | best published |
/// | colourings(6, 3), (7, 3) | 31 x 20, 63 x 35 | 10, 7 | complementary triples; the Fano plane |
/// | colourings(10, 4), CLR10 | 511 x 210 | 25 | best published |

/// Each label is reached by any one of its columns.
inline SignalTable cover_table(const std::vector<std::vector<std::uint32_t>>& rows, std::size_t columns) {
  std::vector<std::vector<double>> matrix;
  for (const auto& row : rows) {
    matrix.emplace_back(columns, 0.0);
    for (const std::uint32_t j : row) matrix.back()[j] = 1;
  }
  return make_table(matrix, columns);
}

/// Columns: the points of the affine space over three elements. Rows: its lines, three points whose sum is 0.
inline SignalTable affine_lines(int dimension) {
  std::uint32_t points = 1;
  for (int k = 0; k < dimension; ++k) points *= 3;
  std::vector<std::vector<std::uint32_t>> lines;
  for (std::uint32_t a = 0; a < points; ++a)
    for (std::uint32_t b = a + 1; b < points; ++b) {
      std::uint32_t c = 0;
      for (std::uint32_t digit = 1; digit < points; digit *= 3)
        c += digit * ((6 - a / digit % 3 - b / digit % 3) % 3);
      if (c > b) lines.push_back({a, b, c});
    }
  return cover_table(lines, points);
}

/// Grossman and Wool's CYC: columns are the edges of the hypercube, rows its cycles of four edges.
inline SignalTable cube_cycles(std::uint32_t dimension) {
  const std::uint32_t corners = std::uint32_t{1} << dimension;
  std::vector<std::uint32_t> edge(std::size_t{dimension} * corners,
                                  0);  // from the lower corner, by direction
  std::uint32_t edges = 0;
  for (std::uint32_t k = 0; k < dimension; ++k)
    for (std::uint32_t v = 0; v < corners; ++v)
      if ((v >> k & 1U) == 0) edge[k * corners + v] = edges++;
  std::vector<std::vector<std::uint32_t>> cycles;
  for (std::uint32_t k = 0; k < dimension; ++k)
    for (std::uint32_t l = k + 1; l < dimension; ++l)
      for (std::uint32_t v = 0; v < corners; ++v) {
        const std::uint32_t along_k = std::uint32_t{1} << k, along_l = std::uint32_t{1} << l;
        if ((v & (along_k | along_l)) != 0) continue;
        cycles.push_back({edge[k * corners + v], edge[k * corners + (v | along_l)], edge[l * corners + v],
                          edge[l * corners + (v | along_k)]});
      }
  return cover_table(cycles, edges);
}

/// Grossman and Wool's CLR: columns are the sets of `size` of the `points` points, rows the colourings of the
/// points in two colours (both used, without regard to their exchange). A set is in a row if all its points
/// have one colour.
inline SignalTable colourings(std::uint32_t points, int size) {
  std::vector<std::uint32_t> sets;
  for (std::uint32_t set = 0; set < (std::uint32_t{1} << points); ++set)
    if (std::popcount(set) == size) sets.push_back(set);
  std::vector<std::vector<std::uint32_t>> rows;
  for (std::uint32_t colouring = 1; colouring < (std::uint32_t{1} << (points - 1)); ++colouring) {
    rows.emplace_back();
    for (std::uint32_t j = 0; j < sets.size(); ++j)
      if (const std::uint32_t common = sets[j] & colouring; common == 0 || common == sets[j])
        rows.back().push_back(j);
  }
  return cover_table(rows, sets.size());
}

}  // namespace shelfbeam::test
