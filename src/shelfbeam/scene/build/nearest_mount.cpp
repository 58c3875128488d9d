#include "shelfbeam/scene/build/nearest_mount.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/math/compass.hpp"
#include "shelfbeam/math/polygon_edges.hpp"

namespace shelfbeam {

namespace {

constexpr double usual_gap = 0.05;     // m below the ceiling
constexpr double usual_offset = 0.02;  // m from a face
constexpr double usual_height = 2.4;   // m, on a face
constexpr double free_height = 2.5;    // m, of a unit without a ceiling
constexpr double clearance = 0.01;     // m from the walls of the room

double ceiling_at(const RoomShape& room, const Vec2& p) {
  return room.ceiling_over(p).at(p);
}

// A vertical face: a straight piece of an outline, with air on the side of its normal.
struct FlatFace {
  Vec2 from, to, outward;
  double bottom, top;  // m
};

// The fixture or wall that has faces, with all of them.
struct Carrier {
  std::string name;
  std::vector<FlatFace> faces;
};

struct FacePlace {
  const Carrier* carrier = nullptr;
  const FlatFace* face = nullptr;
  Vec2 at{};
  double distance = HUGE_VAL;  // in plan, m
};

class Faces {
 public:
  explicit Faces(const Scene& scene) : scene_(scene) {
    for (const FixtureOutline& fixture : scene.fixtures)
      if (fixture.footprint.size() > 2 && fixture.height > 0)
        add(fixture.id, fixture.footprint, fixture.height);
    if (!scene.room) return;
    const double top = scene.room->upper().z;
    const std::vector<OuterWall> walls = scene.room->walls();
    for (std::size_t k = 0; k < walls.size(); ++k)
      carriers_.push_back(
          {fmt::format("wall {}", k), {{walls[k].from, walls[k].to, walls[k].inward, 0, top}}});
  }

  FacePlace nearest(const Vec2& p) const {
    FacePlace best;
    for (const Carrier& carrier : carriers_)
      if (const FacePlace one = nearest_on(carrier, p); one.distance < best.distance) best = one;
    return best;
  }

  // Without places that another fixture or a wall covers.
  FacePlace nearest_on(const Carrier& carrier, const Vec2& p) const {
    FacePlace best;
    for (const FlatFace& face : carrier.faces) {
      const Vec2 at = nearest_point(face.from, face.to, p);
      if (const double away = distance(at, p); away < best.distance && is_free(carrier, face, at))
        best = {&carrier, &face, at, away};
    }
    return best;
  }

  // The face in front of which a unit is mounted, by its axis.
  FacePlace behind(const Transceiver& unit) const {
    constexpr double farthest = 0.3;  // m
    FacePlace best;
    for (const Carrier& carrier : carriers_)
      for (const FlatFace& face : carrier.faces) {
        const Vec2 p{unit.position.x, unit.position.y}, at = nearest_point(face.from, face.to, p);
        const double away = distance(at, p);
        const double before = (p[0] - at[0]) * face.outward[0] + (p[1] - at[1]) * face.outward[1];
        const bool looks_away = unit.axis.x * face.outward[0] + unit.axis.y * face.outward[1] > 0.1;
        if (looks_away && before >= 0 && away < std::min(farthest, best.distance) &&
            unit.position.z <= face.top && unit.position.z >= face.bottom)
          best = {&carrier, &face, at, away};
      }
    return best;
  }

 private:
  bool is_free(const Carrier& carrier, const FlatFace& face, const Vec2& at) const {
    const Vec2 before{at[0] + usual_offset * face.outward[0], at[1] + usual_offset * face.outward[1]};
    if (scene_.room && !scene_.room->covers(before)) return false;
    return std::none_of(scene_.fixtures.begin(), scene_.fixtures.end(), [&](const FixtureOutline& other) {
      return other.id != carrier.name && other.height >= face.top && contains(other.footprint, before);
    });
  }

  void add(const std::string& id, const Polygon& outline, double height) {
    Carrier carrier{id, {}};
    const std::vector<Vec2> normals = outward_normals(outline);
    for (std::size_t k = 0; k < outline.size(); ++k)
      carrier.faces.push_back({outline[k], outline[(k + 1) % outline.size()], normals[k], 0, height});
    carriers_.push_back(std::move(carrier));
  }

  const Scene& scene_;
  std::vector<Carrier> carriers_;
};

// On a face at a height, or as near to it as the face reaches.
Vec3 before(const Scene& scene, const FacePlace& place, double offset, double z) {
  constexpr double margin = 0.05;  // m from the edges of the face, and below the ceiling
  const auto& [from, to, outward, bottom, whole] = *place.face;
  const Vec2 p{place.at[0] + offset * outward[0], place.at[1] + offset * outward[1]};
  const double top =
      scene.room && scene.room->covers(p) ? std::min(whole, ceiling_at(*scene.room, p)) : whole;
  const double height = top - bottom > 2 * margin ? std::clamp(z, bottom + margin, top - margin) : top / 2;
  return {p[0], p[1], height};
}

struct RailPlace {
  const MountRail* rail = nullptr;
  Vec3 at{};
  double distance = HUGE_VAL;  // in plan, m
};

RailPlace nearest_on(const MountRail& rail, const Vec2& p) {
  RailPlace best;
  for (std::size_t k = 1; k < rail.points.size(); ++k) {
    const Vec3 &a = rail.points[k - 1], &b = rail.points[k];
    const Vec2 from{a.x, a.y}, to{b.x, b.y}, at = nearest_point(from, to, p);
    const double away = distance(at, p), whole = distance(from, to);
    const double share = whole > 0 ? distance(from, at) / whole : 0;
    if (away < best.distance) best = {&rail, {at[0], at[1], a.z + share * (b.z - a.z)}, away};
  }
  return best;
}

RailPlace nearest_rail(const Store& store, const Vec2& p) {
  RailPlace best;
  for (const auto& [rail, where] : store.rails)
    if (const RailPlace one = nearest_on(rail, p); one.distance < best.distance) best = one;
  return best;
}

// The point, or the nearest one in the room.
Vec2 within(const std::optional<RoomShape>& room, const Vec2& p) {
  if (!room || room->covers(p)) return p;
  Vec2 best = p;
  double least = HUGE_VAL;
  for (const OuterWall& wall : room->walls()) {
    // Not in a corner, where the next wall is as near.
    const double margin = std::min(clearance / std::max(wall.length(), clearance), 0.5);
    const auto along = [&](double share) {
      return Vec2{wall.from[0] + share * (wall.to[0] - wall.from[0]),
                  wall.from[1] + share * (wall.to[1] - wall.from[1])};
    };
    const Vec2 at = nearest_point(along(margin), along(1 - margin), p);
    const Vec2 inside{at[0] + clearance * wall.inward[0], at[1] + clearance * wall.inward[1]};
    if (const double away = distance(inside, p); away < least && room->covers(inside)) {
      best = inside;
      least = away;
    }
  }
  return best;
}

// The axis after a turn about the vertical from one direction in plan to another.
Vec3 turned(const Vec3& axis, const Vec2& from, const Vec2& to) {
  const double cosine = from[0] * to[0] + from[1] * to[1], sine = from[0] * to[1] - from[1] * to[0];
  return {cosine * axis.x - sine * axis.y, sine * axis.x + cosine * axis.y, axis.z};
}

}  // namespace

MountPlace nearest_mount(const Store& store, const Scene& scene, const PointedAt& at, double reach) {
  const auto attracts = [reach](double distance) { return reach > 0 && distance <= reach; };
  if (const RailPlace rail = nearest_rail(store, at.plan); rail.rail != nullptr && attracts(rail.distance))
    return {rail.at, rail.rail->unit.axes.front(), MountKind::rail, rail.rail->id};
  const Faces faces(scene);
  if (const FacePlace face = faces.nearest(at.plan); face.face != nullptr && attracts(face.distance))
    return {before(scene, face, usual_offset, at.z.value_or(usual_height)),
            {face.face->outward[0], face.face->outward[1], 0},
            MountKind::face,
            face.carrier->name};
  const Vec2 p = within(scene.room, at.plan);
  if (!scene.room) return {{p[0], p[1], at.z.value_or(free_height)}};
  return {{p[0], p[1], ceiling_at(*scene.room, p) - usual_gap}, {0, 0, -1}, MountKind::ceiling};
}

MountPlace moved_mount(const Store& store, const Scene& scene, const Transceiver& unit, const PointedAt& at) {
  constexpr double on_rail = 0.01, below_ceiling = 0.5;  // m
  const Vec3& now = unit.position;
  for (const auto& [rail, where] : store.rails)
    if (length(nearest_on(rail, {now.x, now.y}).at - now) <= on_rail)
      return {nearest_on(rail, at.plan).at, unit.axis, MountKind::rail, rail.id};
  const Vec2 here{now.x, now.y};
  const bool is_inside = scene.room && scene.room->covers(here);
  const double gap = is_inside ? ceiling_at(*scene.room, here) - now.z : HUGE_VAL;
  const Faces faces(scene);
  // A tilted unit below the ceiling may be close to a wall.
  const FacePlace from = faces.behind(unit);
  const FacePlace to = from.carrier == nullptr || (gap >= 0 && gap < from.distance)
                           ? FacePlace{}
                           : faces.nearest_on(*from.carrier, at.plan);
  if (to.face != nullptr) {
    return {before(scene, to, std::max(from.distance, 1e-3), at.z.value_or(now.z)),
            turned(unit.axis, from.face->outward, to.face->outward), MountKind::face, to.carrier->name};
  }
  const Vec2 p = within(scene.room, at.plan);
  if (gap >= 0 && gap <= below_ceiling)
    return {{p[0], p[1], ceiling_at(*scene.room, p) - gap}, unit.axis, MountKind::ceiling};
  const double top = scene.room ? ceiling_at(*scene.room, p) : HUGE_VAL;
  return {{p[0], p[1], std::min(at.z.value_or(now.z), top)}, unit.axis, MountKind::free};
}

}  // namespace shelfbeam
