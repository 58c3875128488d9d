#pragma once

#include <array>
#include <string>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// A direction on the drawing, whose x axis points to the right and whose y axis points up.
enum class Side { left, right, bottom, top };

/// The distance in plan from a unit to something that a fitter can measure from.
struct Reference {
  enum class Kind {
    wall,     ///< of the room
    fixture,  ///< the near face of a fixture beside the unit
    end,      ///< a side of a fixture below the unit
    ceiling,  ///< the edge of a zone with a ceiling below the unit
    origin    ///< the axis of the drawing, if there is nothing else
  };

  Side side = Side::left;  ///< the direction from the unit to the reference
  Kind kind = Kind::origin;
  std::string fixture;  ///< its id
  double distance = 0;  ///< m
  double ceiling = 0;   ///< of a ceiling: its height at the edge, m
};

/// The references along x and along y: the nearest surface at the height of the unit, which a laser at the
/// unit meets. To a slanted surface the distance depends on the exact position and aim of the laser. So a
/// surface that is square to the laser precedes a slanted one in the opposite direction, and a slanted one
/// precedes a surface that is more along the laser than across it. Where there is none of the former within
/// `far_surface`, the nearest face of a fixture in plan, at any height, takes its place if it is better.
std::array<Reference, 2> references_of(const Scene& scene, const Vec3& unit);

inline constexpr double far_surface = 30;  ///< m, the range of a laser that a fitter has

}  // namespace shelfbeam
