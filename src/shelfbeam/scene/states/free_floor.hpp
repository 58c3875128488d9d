#pragma once

#include <map>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The floor of a shop between its fixtures and walls.
class FreeFloor {
 public:
  /// `scene` must outlive the object.
  explicit FreeFloor(const Scene& scene);

  /// Whether a block of this height may stand on a convex part of the plan: within the room, below its
  /// ceilings, outside holes and inner walls, and clear of fixtures, labels and installed units.
  bool is_free(const Polygon& plan, double height) const;

 private:
  static std::vector<Part> obstacles_of(const Scene& scene);

  const Scene& scene_;
  std::vector<Part> obstacles_;  ///< convex in plan
  BoxIndex index_;
};

/// Free floor on which blocks stand one after the other.
class TakenFloor {
 public:
  /// `floor` must outlive the object.
  explicit TakenFloor(const FreeFloor& floor) : floor_(floor) {}

  /// Takes a convex part of the plan for a block if it is free. Returns whether it is.
  bool take(const Polygon& plan, double height);

 private:
  const FreeFloor& floor_;
  struct Taken {
    PlanBounds bounds;
    Polygon plan;
  };
  std::multimap<double, Taken> taken_;  ///< by their smallest x
  double longest_ = 0;                  ///< along x
};

}  // namespace shelfbeam
