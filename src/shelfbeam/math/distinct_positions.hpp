#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// Positions are one place when all coordinates are equal up to this, m.
inline constexpr double place_tolerance = 1e-6;

/// Which positions are the same place.
struct Places {
  std::vector<std::uint32_t> of;  ///< the place of every position, counted from 0 as they first appear
  std::size_t count = 0;
};

/// Along each axis, coordinates that follow one another within the tolerance are equal. So "the same place"
/// is transitive, and does not depend on the order of the positions.
Places places_of(std::span<const Vec3> positions);

/// The positions of things that have one.
template <class Thing>
std::vector<Vec3> positions_of(const std::vector<Thing>& things) {
  std::vector<Vec3> positions;
  positions.reserve(things.size());
  for (const Thing& thing : things) positions.push_back(thing.position);
  return positions;
}

}  // namespace shelfbeam
