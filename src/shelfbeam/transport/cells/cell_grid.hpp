#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam::detail {

/// The axis that a normal faces, 0 to 2.
inline int facing_axis(const Vec3& normal) {
  const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
  return z >= x && z >= y ? 2 : x >= y ? 0 : 1;
}

/// A grid of cubes. The surfaces in a cube that face the same way, of six, are a cell.
struct CellGrid {
  static constexpr double size = 0.5;  ///< m
  /// Shifts the borders of cells off those of shelves and floors, so that rounding moves no points across
  /// them.
  static constexpr double shift = 0.1370;
  using Cube = std::array<std::int64_t, 3>;

  static Vec3 scaled(const Vec3& p) {
    return {(p.x + shift) / size, (p.y + shift) / size, (p.z + shift) / size};
  }
  static Cube cube(const Vec3& scaled) {
    return {static_cast<std::int64_t>(std::floor(scaled.x)), static_cast<std::int64_t>(std::floor(scaled.y)),
            static_cast<std::int64_t>(std::floor(scaled.z))};
  }
  static Bounds box(const Cube& cube) {
    Bounds box;
    box.low = {static_cast<double>(cube[0]) * size - shift, static_cast<double>(cube[1]) * size - shift,
               static_cast<double>(cube[2]) * size - shift};
    box.high = box.low + Vec3{size, size, size};
    return box;
  }

  /// Identifies a cell; less than 2^63.
  static std::uint64_t key(const Cube& cube, const Vec3& normal) {
    constexpr std::array<std::uint64_t, 3> first{2, 4, 0};  // of the two facings along an axis
    const auto bits = [](std::int64_t c) { return static_cast<std::uint64_t>(c & 0xFFFFF); };
    const int axis = facing_axis(normal);
    const std::uint64_t facing = first[static_cast<std::size_t>(axis)] + (normal[axis] > 0 ? 0 : 1);
    return (bits(cube[0]) << 43) | (bits(cube[1]) << 23) | (bits(cube[2]) << 3) | facing;
  }
  static std::uint64_t key(const SurfacePoint& point) {
    return key(cube(scaled(point.position)), point.normal);
  }

  /// The quarter of its cell that contains a point, along the two axes that the surface does not face.
  static std::uint32_t quadrant(const SurfacePoint& point) {
    const Vec3 at = scaled(point.position);
    const int axis = facing_axis(point.normal);
    const auto upper = [](double c) { return c - std::floor(c) < 0.5 ? 0U : 1U; };
    return 2 * upper(axis == 0 ? at.y : at.x) + upper(axis == 2 ? at.y : at.z);
  }

  /// The block of 4 x 4 x 4 cubes around a cell.
  static std::uint64_t block(std::uint64_t key) {
    constexpr std::uint64_t high = 0x3FFFF;  // bits of a coordinate in cubes, without the lowest two
    return key & (high << 45 | high << 25 | high << 5);
  }
};

}  // namespace shelfbeam::detail
