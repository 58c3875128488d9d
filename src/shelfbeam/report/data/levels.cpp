#include "shelfbeam/report/data/levels.hpp"

#include <algorithm>
#include <numeric>

#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

std::string ShelfLevel::heights() const {
  const std::string from = fixed(low, 2), to = fixed(high, 2);
  return from == to ? "labels at " + from + "\u00A0m" : "labels at " + from + " to " + to + "\u00A0m";
}

std::vector<ShelfLevel> shelf_levels(std::span<const double> heights) {
  std::vector<std::uint32_t> order(heights.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return heights[a] < heights[b]; });
  // A hair above the band, so that heights written with two decimals fall on the side they seem to.
  constexpr double slack = 1e-9;
  std::vector<ShelfLevel> levels;
  for (const std::uint32_t label : order) {
    const double z = heights[label];
    if (levels.empty() || z - levels.back().low > level_band + slack) levels.push_back({z, z, {}});
    levels.back().high = z;
    levels.back().labels.push_back(label);
  }
  for (ShelfLevel& level : levels) std::sort(level.labels.begin(), level.labels.end());
  return levels;
}

}  // namespace shelfbeam
