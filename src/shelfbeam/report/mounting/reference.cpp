#include "shelfbeam/report/mounting/reference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

namespace {

constexpr double slack = 1e-6;  // m
// The lean of a face: the change of the distance per length along the face across the axis.
constexpr double square_lean = 0.01, max_lean = 0.5;

enum class Quality { poor, slanted, square };

Quality quality_of(double along, double across) {
  return along <= square_lean * across ? Quality::square
         : along <= max_lean * across  ? Quality::slanted
                                       : Quality::poor;
}

struct Crossing {
  double distance = 0;
  Quality quality = Quality::square;
};

// The first crossing of a polygon's edge from `from` along +x or -x (axis 0) or y (axis 1).
std::optional<Crossing> crossing(std::span<const Vec2> polygon, const Vec2& from, std::size_t axis,
                                 double sign) {
  const std::size_t other = 1 - axis;
  std::optional<Crossing> nearest;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[other] > from[other]) == (b[other] > from[other])) continue;
    const double share = (from[other] - a[other]) / (b[other] - a[other]);
    const double distance = sign * (a[axis] + share * (b[axis] - a[axis]) - from[axis]);
    if (distance > -slack && (!nearest || distance < nearest->distance))
      nearest = Crossing{std::max(0.0, distance),
                         quality_of(std::abs(b[axis] - a[axis]), std::abs(b[other] - a[other]))};
  }
  return nearest;
}

// Where a horizontal axis meets a triangle.
std::optional<Crossing> hit(const std::array<Vec3, 3>& corners, const Vec3& from, std::size_t axis,
                            double sign) {
  const auto along = static_cast<int>(axis), u = 1 - along;
  // In the plane across the axis: coordinates u and z.
  const auto area = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    return (b[u] - a[u]) * (c.z - a.z) - (b.z - a.z) * (c[u] - a[u]);
  };
  const double all = area(corners[0], corners[1], corners[2]);
  if (std::abs(all) < slack * slack) return {};
  double at = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const double share = area(from, corners[(k + 1) % 3], corners[(k + 2) % 3]) / all;
    if (share < 0) return {};
    at += share * corners[k][along];
  }
  const double distance = sign * (at - from[along]);
  if (distance <= -slack) return {};
  const Vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  return Crossing{std::max(0.0, distance), quality_of(std::abs(normal[u]), std::abs(normal[along]))};
}

class Search {
 public:
  Search(const Scene& scene, const Vec3& unit, std::size_t axis) : scene_(scene), unit_(unit), axis_(axis) {}

  Reference nearest() {
    if (scene_.room) {
      meet_walls(scene_.room->outline);
      for (const Polygon& hole : scene_.room->holes) meet_walls(hole);
      for (const CeilingZone& zone : scene_.room->zones) meet_ceiling(zone);
    }
    for (const double sign : {-1.0, 1.0}) meet_parts(sign);
    std::optional<Met> best = chosen();
    if (!best || best->rank() < Quality::slanted) {
      first_ = {};
      for (const double sign : {-1.0, 1.0}) meet_outlines(sign);
      const std::optional<Met> low = chosen();
      if (!best || (low && low->rank() > best->rank())) best = low;
    }
    if (best) return best->reference;
    return {axis_ == 0 ? Side::left : Side::bottom, Reference::Kind::origin, "",
            axis_ == 0 ? unit_.x : unit_.y, 0};
  }

 private:
  struct Met {
    Reference reference;
    Quality quality = Quality::square;

    Quality rank() const { return reference.distance <= far_surface ? quality : Quality::poor; }
  };

  Vec2 in_plan() const { return {unit_.x, unit_.y}; }

  // The first surface in each direction counts, because it hides those beyond it.
  std::optional<Met> chosen() const {
    const auto& [back, ahead] = first_;
    if (!back || !ahead) return back ? back : ahead;
    if (back->rank() != ahead->rank()) return back->rank() > ahead->rank() ? back : ahead;
    const double nearer = back->reference.distance - ahead->reference.distance;
    if (std::abs(nearer) <= slack && ahead->reference.kind == Reference::Kind::wall)
      return back->reference.kind == Reference::Kind::wall ? back : ahead;
    return nearer > slack ? ahead : back;
  }

  void offer(double sign, const Crossing& at, Reference::Kind kind, const std::string& fixture = {},
             double ceiling = 0) {
    std::optional<Met>& first = sign < 0 ? first_[0] : first_[1];
    if (at.distance < 0 || (first && at.distance >= first->reference.distance - slack)) return;
    const Side side =
        axis_ == 0 ? (sign < 0 ? Side::left : Side::right) : (sign < 0 ? Side::bottom : Side::top);
    first = Met{{side, kind, fixture, at.distance, ceiling}, at.quality};
  }

  void meet_walls(const Polygon& polygon) {
    for (const double sign : {-1.0, 1.0})
      if (const auto at = crossing(polygon, in_plan(), axis_, sign)) offer(sign, *at, Reference::Kind::wall);
  }

  // The upright face at the edge of a lower ceiling.
  void meet_ceiling(const CeilingZone& zone) {
    for (const double sign : {-1.0, 1.0}) {
      const auto at = crossing(zone.polygon, in_plan(), axis_, sign);
      if (!at) continue;
      Vec2 beyond = in_plan();
      beyond[axis_] += sign * (at->distance + 2 * slack);
      if (contains(zone.polygon, beyond) && zone.height.at(beyond) < unit_.z - slack)
        offer(sign, *at, Reference::Kind::ceiling, {}, zone.height.at(beyond));
    }
  }

  // Surfaces at the height of the unit.
  void meet_parts(double sign) {
    for (const Part& part : scene_.parts) {
      if (part.kind == PartKind::shell || part.fixture >= scene_.fixtures.size()) continue;
      const std::string& id = scene_.fixtures[part.fixture].id;
      if (part.triangle_count > 0) {
        meet_mesh(part, unit_, sign);
      } else if (part.bottom <= unit_.z && unit_.z <= part.top && !contains(part.footprint, in_plan())) {
        if (const auto at = crossing(part.footprint, in_plan(), axis_, sign))
          offer(sign, *at, Reference::Kind::fixture, id);
      }
    }
  }

  // Faces of fixtures in plan, at any height: those of meshes at half their height.
  void meet_outlines(double sign) {
    for (const FixtureOutline& fixture : scene_.fixtures) {
      if (fixture.footprint.size() < 3 || fixture.form == FixtureForm::mesh) continue;
      const bool is_below = contains(fixture.footprint, in_plan());
      if (const auto at = crossing(fixture.footprint, in_plan(), axis_, sign))
        offer(sign, *at, is_below ? Reference::Kind::end : Reference::Kind::fixture, fixture.id);
    }
    for (const Part& part : scene_.parts)
      meet_mesh(part, {unit_.x, unit_.y, (part.bottom + part.top) / 2}, sign);
  }

  void meet_mesh(const Part& part, const Vec3& from, double sign) {
    if (part.fixture >= scene_.fixtures.size()) return;
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      const auto& [a, b, c] = scene_.mesh.triangles[t];
      const auto& v = scene_.mesh.vertices;
      if (const auto at = hit({v[a], v[b], v[c]}, from, axis_, sign))
        offer(sign, *at, Reference::Kind::fixture, scene_.fixtures[part.fixture].id);
    }
  }

  const Scene& scene_;
  const Vec3& unit_;
  std::size_t axis_;
  std::array<std::optional<Met>, 2> first_;  ///< towards smaller and towards larger coordinates
};

}  // namespace

std::array<Reference, 2> references_of(const Scene& scene, const Vec3& unit) {
  return {Search(scene, unit, 0).nearest(), Search(scene, unit, 1).nearest()};
}

}  // namespace shelfbeam
