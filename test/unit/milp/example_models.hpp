#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "shelfbeam/milp/model.hpp"

namespace shelfbeam::test {

/// Covering model with unit costs: rows of 0/1 entries, each covered at least once.
inline milp::Model cover(std::size_t columns, const std::vector<std::vector<std::uint32_t>>& rows) {
  milp::Model model;
  model.columns.resize(columns);
  for (milp::Column& column : model.columns) column.cost = 1;
  for (const auto& row : rows) model.rows.push_back(milp::sum_row(row, 1, milp::infinity));
  return model;
}

/// Vertex cover of the triangle: the optimum is 2, the LP relaxation gives 1.5.
inline milp::Model triangle() {
  return cover(3, {{0, 1}, {1, 2}, {0, 2}});
}

/// Cover of the lines of an affine space over three elements with `points` points. 27 points, Fulkerson's
/// A27: 117 lines, optimum 18. 81 points, A81: 1080 lines, optimum 61 (Ostrowski, Linderoth, Rossi, Smriglio
/// 2011), which no general solver proves within minutes.
inline milp::Model steiner(std::uint32_t points) {
  std::vector<std::vector<std::uint32_t>> lines;
  const auto third = [points](std::uint32_t a, std::uint32_t b) {
    std::uint32_t c = 0;
    for (std::uint32_t digit = 1; digit < points; digit *= 3)
      c += digit * ((6 - a / digit % 3 - b / digit % 3) % 3);
    return c;
  };
  for (std::uint32_t a = 0; a < points; ++a)
    for (std::uint32_t b = a + 1; b < points; ++b)
      if (const std::uint32_t c = third(a, b); c > b) lines.push_back({a, b, c});
  return cover(points, lines);
}

inline milp::Model steiner_81() {
  return steiner(81);
}

/// Integer columns in [-2, 3], rows of every sense, costs of either sign; may be infeasible.
inline milp::Model random_model(std::mt19937_64& random) {
  const auto whole = [&](int low, int high) {
    return static_cast<double>(std::uniform_int_distribution<int>(low, high)(random));
  };
  milp::Model model;
  const auto columns = static_cast<std::uint32_t>(whole(1, 6));
  for (std::uint32_t j = 0; j < columns; ++j) {
    const double low = whole(-2, 1);
    model.columns.push_back({whole(-5, 5) / 4, low, low + whole(0, 2), true, {}});
  }
  for (int i = static_cast<int>(whole(0, 4)); i > 0; --i) {
    milp::Row row;
    for (std::uint32_t j = 0; j < columns; ++j)
      if (whole(0, 2) > 0) row.entries.push_back({j, whole(-3, 3)});
    const double bound = whole(-4, 6);
    const double sense = whole(0, 3);
    if (sense != 1) row.lower = bound;
    if (sense != 0) row.upper = sense == 3 ? bound + 2 : bound;
    model.rows.push_back(row);
  }
  return model;
}

/// The minimum objective by enumeration; infinity if infeasible. All columns must be integer and bounded.
inline double try_everything(const milp::Model& model) {
  std::vector<double> x;
  for (const milp::Column& column : model.columns) x.push_back(column.lower);
  double best = milp::infinity;
  while (true) {
    bool fits = true;
    for (const milp::Row& row : model.rows) {
      double sum = 0;
      for (const milp::Entry& entry : row.entries) sum += entry.value * x[entry.column];
      fits = fits && sum >= row.lower && sum <= row.upper;
    }
    double value = 0;
    for (std::size_t j = 0; j < x.size(); ++j) value += model.columns[j].cost * x[j];
    if (fits && value < best) best = value;
    std::size_t j = 0;
    while (j < x.size() && x[j] == model.columns[j].upper) x[j] = model.columns[j].lower, ++j;
    if (j == x.size()) return best;
    x[j] += 1;
  }
}

}  // namespace shelfbeam::test
