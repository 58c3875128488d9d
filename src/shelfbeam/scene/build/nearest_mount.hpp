#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "shelfbeam/base/names.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

enum class MountKind : std::uint8_t { ceiling, rail, face, free };
template <>
inline constexpr auto names_of<MountKind> = std::to_array<Named<MountKind>>({{"ceiling", MountKind::ceiling},
                                                                             {"rail", MountKind::rail},
                                                                             {"face", MountKind::face},
                                                                             {"free", MountKind::free}});

/// A place where a unit can be mounted.
struct MountPlace {
  Vec3 position;  ///< m
  Vec3 axis{0, 0, -1};
  MountKind on = MountKind::free;
  std::string name = {};  ///< of the rail, the fixture, the inner wall or the wall of the room ("wall 2")
};

/// A point to which a hand points: in plan, perhaps with a height, m.
struct PointedAt {
  Vec2 plan;
  std::optional<double> z;
};

/// Where a new unit is mounted near a point: on a rail or a face within `reach` (m) in plan, otherwise below
/// the ceiling; without a room, at the height of the point.
MountPlace nearest_mount(const Store& store, const Scene& scene, const PointedAt& at, double reach);

/// The place nearest to a point on the surface that carries a unit: on its rail, around its fixture or wall
/// at its distance from it, or below the ceiling at its distance from this. A unit that nothing carries keeps
/// its height. Tilts stay; around a corner, the axis turns. The result is within the room.
MountPlace moved_mount(const Store& store, const Scene& scene, const Transceiver& unit, const PointedAt& at);

}  // namespace shelfbeam
