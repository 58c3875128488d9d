#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// Positions count as equal when every coordinate agrees within this tolerance, m.
inline constexpr double position_tolerance = 1e-6;

/// Groups of equal positions.
struct DistinctPositions {
  std::vector<std::uint32_t> group_of;  ///< the group of every position, numbered from 0 by first appearance
  std::size_t count = 0;                ///< number of groups
};

/// Along each axis, successive sorted coordinates within the tolerance of each other count as equal. Equality
/// of positions is therefore transitive and does not depend on their order.
DistinctPositions distinct_positions(std::span<const Vec3> positions);

/// The `position` member of every element.
template <class Thing>
std::vector<Vec3> positions_of(const std::vector<Thing>& things) {
  std::vector<Vec3> positions;
  positions.reserve(things.size());
  for (const Thing& thing : things) positions.push_back(thing.position);
  return positions;
}

}  // namespace shelfbeam
