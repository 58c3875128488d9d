#include "shelfbeam/math/distinct_positions.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

namespace shelfbeam {

namespace {

// The rank of every position's coordinate along an axis; equal coordinates have the same rank.
std::vector<std::uint32_t> ranks(std::span<const Vec3> positions, int axis) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return positions[a][axis] < positions[b][axis]; });
  std::vector<std::uint32_t> rank(positions.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double step = positions[order[k]][axis] - positions[order[k - 1]][axis];
    rank[order[k]] = rank[order[k - 1]] + (step > position_tolerance ? 1 : 0);
  }
  return rank;
}

}  // namespace

DistinctPositions distinct_positions(std::span<const Vec3> positions) {
  const std::array<std::vector<std::uint32_t>, 3> rank = {ranks(positions, 0), ranks(positions, 1),
                                                          ranks(positions, 2)};
  std::map<std::array<std::uint32_t, 3>, std::uint32_t> known;
  DistinctPositions groups;
  groups.group_of.reserve(positions.size());
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const auto next = static_cast<std::uint32_t>(known.size());
    groups.group_of.push_back(known.try_emplace({rank[0][k], rank[1][k], rank[2][k]}, next).first->second);
  }
  groups.count = known.size();
  return groups;
}

}  // namespace shelfbeam
