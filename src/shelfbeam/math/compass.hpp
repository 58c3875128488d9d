#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/math/vec3.hpp"

namespace shelfbeam {

/// The directions of the compass in plan: north is +y, and east is +x.
enum class Compass : std::uint8_t { north, east, south, west };

template <>
inline constexpr auto names_of<Compass> = std::to_array<Named<Compass>>(
    {{"north", Compass::north}, {"east", Compass::east}, {"south", Compass::south}, {"west", Compass::west}});

/// The unit vector of a direction.
inline Vec2 vector_of(Compass direction) {
  constexpr std::array<Vec2, 4> vectors{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};
  return vectors[static_cast<std::size_t>(direction)];
}

/// The unit normals of the edges of a polygon without fault: edge k runs from corner k to corner k + 1.
std::vector<Vec2> outward_normals(const Polygon& polygon);

/// The edges of a polygon without fault whose outward normal is less than 45 degrees from a direction, in
/// runs of consecutive edges. So an edge belongs to at most one direction.
std::vector<std::vector<std::size_t>> edges_towards(const Polygon& polygon, Compass direction);

}  // namespace shelfbeam
