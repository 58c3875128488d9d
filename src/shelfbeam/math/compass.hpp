#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// The directions of the compass in plan: north is +y, and east is +x.
enum class Compass : std::uint8_t { north, east, south, west };

inline constexpr std::array<std::string_view, 4> compass_names{"north", "east", "south", "west"};

inline std::string_view to_text(Compass direction) {
  return compass_names[static_cast<std::size_t>(direction)];
}

/// The unit normals of the edges of a polygon without fault: edge k runs from corner k to corner k + 1.
std::vector<Vec2> outward_normals(const Polygon& polygon);

/// The edges of a polygon without fault whose outward normal is less than 45 degrees from a direction, in
/// runs of consecutive edges. So an edge belongs to at most one direction.
std::vector<std::vector<std::size_t>> edges_towards(const Polygon& polygon, Compass direction);

}  // namespace shelfbeam
