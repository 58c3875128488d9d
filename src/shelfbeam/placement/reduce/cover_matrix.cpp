#include "shelfbeam/placement/reduce/cover_matrix.hpp"

#include <algorithm>

#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

CoverMatrix::CoverMatrix(const Instance& instance, std::span<const double> costs,
                         const Reduction& reduction) {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> place(instance.columns(), none);
  const std::vector<bool> blocked = blocked_columns(instance, reduction);
  for (const CoverPart& part : reduction.parts)
    for (const std::uint32_t j : part.columns) {
      if (blocked[j] || part.labels.empty()) continue;
      place[j] = static_cast<std::uint32_t>(column_of.size());
      column_of.push_back(j);
      cost.push_back(costs[j]);
    }
  columns.resize(column_of.size());
  const CoverRows cover(instance);
  for (const CoverPart& part : reduction.parts)
    for (const LabelId label : part.labels) {
      const auto i = static_cast<std::uint32_t>(rows.size());
      std::vector<std::uint32_t>& row = rows.emplace_back();
      cover.for_entries(label, [&](std::uint32_t j, double) {
        if (place[j] != none) row.push_back(place[j]);
      });
      std::sort(row.begin(), row.end());
      for (const std::uint32_t j : row) columns[j].push_back(i);
    }
}

}  // namespace shelfbeam::detail
