#pragma once

#include <span>
#include <string>
#include <vector>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The place of a unit or a candidate, as a person in the shop finds it.
struct ShopPlace {
  enum class Kind {
    none,     ///< far from everything that has a name
    at,       ///< on the face of a fixture, or within it
    above,    ///< above a fixture
    aisle,    ///< above the way between two fixtures, or between a fixture and a wall
    between,  ///< between them, and not higher than both
    beside,   ///< next to a fixture
    zone      ///< below the ceiling of a zone of the room
  };

  Kind kind = Kind::none;
  std::string fixture = {};  ///< its id
  std::string other = {};    ///< of aisle and between: the id of the second fixture; empty: a wall
  double ceiling = 0;        ///< of zone: the height of its ceiling above the place, m

  friend bool operator==(const ShopPlace&, const ShopPlace&) = default;
};

/// Finds places among the fixtures that stand on the floor and cover neither others nor much of it. A wall
/// between a place and a fixture hides the fixture.
class ShopPlaces {
 public:
  /// `scene` must outlive the object.
  explicit ShopPlaces(const Scene& scene);

  ShopPlace of(const Vec3& position) const;

 private:
  struct Near;

  std::vector<Near> near(const Vec3& position) const;
  bool is_hidden(const Vec2& from, const Vec2& to) const;
  std::vector<Near> walls_near(const Vec2& from) const;

  const Scene& scene_;
  std::span<const FixtureOutline> inner_walls_;
  std::vector<std::size_t> standing_;  ///< of scene.fixtures, by the order of the index
  BoxIndex index_;
};

inline constexpr double near_distance = 3;  ///< m, in plan, to a fixture beside a place
inline constexpr double max_aisle = 5;      ///< m, the width of a way between two fixtures

}  // namespace shelfbeam
