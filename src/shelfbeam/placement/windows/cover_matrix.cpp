#include "shelfbeam/placement/windows/cover_matrix.hpp"

#include <algorithm>
#include <limits>

#include "shelfbeam/placement/problem/cover_rows.hpp"
#include "shelfbeam/placement/windows/divided_rows.hpp"

namespace shelfbeam::detail {

CoverMatrix::CoverMatrix(const Instance& instance, std::span<const double> costs,
                         const Reduction& reduction) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(instance.columns(), none);
  for (const CoverPart& part : reduction.parts)
    for (const std::uint32_t j : part.columns) {
      place[j] = static_cast<std::uint32_t>(column_of.size());
      column_of.push_back(j);
      cost.push_back(costs[j]);
    }
  columns.resize(column_of.size());
  const CoverRows cover(instance);
  for (const CoverPart& part : reduction.parts)
    for (const std::uint32_t label : part.labels) {
      const auto i = static_cast<std::uint32_t>(rows.size());
      std::vector<std::uint32_t>& row = rows.emplace_back();
      cover.for_entries(label, [&](std::uint32_t j, double) {
        if (place[j] != none) row.push_back(place[j]);
      });
      std::sort(row.begin(), row.end());
      for (const std::uint32_t j : row) columns[j].push_back(i);
    }
}

std::vector<std::vector<std::uint32_t>> divided_rows(const CoverMatrix& cover, std::size_t parts) {
  std::vector<milp::Row> rows(cover.rows.size());
  std::vector<double> mass(rows.size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (const std::uint32_t j : cover.rows[i]) {
      rows[i].entries.push_back({j, 1.0});
      mass[i] = std::min(mass[i], cover.cost[j] / static_cast<double>(cover.columns[j].size()));
    }
  return divided_rows(rows, cover.columns.size(), mass, parts);
}

}  // namespace shelfbeam::detail
