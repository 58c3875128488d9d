#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// A unit that lights a surface so closely that the light on and around it changes within centimetres.
struct CloseUnit {
  Vec3 position;
  Vec3 normal;  ///< of the surface's plane
  double offset = 0;
  double finest = 0;  ///< m, the sides of the smallest parts of cells
};

/// Divides a cell (CellGrid) into parts. Points in different parts do not see each other, because a wall, a
/// column or a shelf board runs through the cell; the parts around a close unit are small. They are the
/// leaves of a binary tree of planes.
class CellDivision {
 public:
  static constexpr std::size_t max_parts = 2048;

  /// A plane, and what lies on either side of it.
  struct Plane {
    Vec3 normal;
    double offset = 0;
    /// Below and above the plane: a part, or `inner` plus the number of another plane.
    std::array<std::uint32_t, 2> sides{};
  };
  static constexpr std::uint32_t inner = 1U << 31;

  /// Traces rays between the points of a cell, just above its surface. Panes do not divide it. `key`
  /// identifies the cell.
  CellDivision(const World& world, std::vector<SurfacePoint> points, std::span<const CloseUnit> units,
               std::uint64_t key);

  /// The points of each part, at least one; parts close to a unit have further points.
  const std::vector<std::vector<SurfacePoint>>& parts() const { return parts_; }
  const std::vector<Plane>& planes() const { return planes_; }
  /// Whether a close unit divides the cell.
  bool is_fine() const { return !units_.empty() && parts_.size() > 4; }

  /// Whether these are the planes of one division.
  static bool fit(std::span<const Plane> planes);
  /// The part of a point; `planes` are those of one division.
  static std::uint32_t part(std::span<const Plane> planes, const SurfacePoint& point);

 private:
  std::uint32_t divide(std::vector<SurfacePoint> points, const Bounds& box);
  bool is_within_path(const SurfacePoint& point) const;

  const World& world_;
  std::uint64_t key_;
  std::vector<CloseUnit> units_;
  std::vector<std::vector<SurfacePoint>> parts_;
  std::vector<Plane> planes_;
  std::vector<std::pair<std::uint32_t, bool>>
      path_;  ///< planes that contain the next part, and whether it is above
};

}  // namespace shelfbeam::detail
