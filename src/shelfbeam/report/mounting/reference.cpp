#include "shelfbeam/report/mounting/reference.hpp"

#include <algorithm>
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

// The first crossing of a polygon's edge from `from` along +x or -x (axis 0) or y (axis 1).
std::optional<double> crossing(std::span<const Vec2> polygon, const Vec2& from, std::size_t axis,
                               double sign) {
  const std::size_t other = 1 - axis;
  std::optional<double> nearest;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[other] > from[other]) == (b[other] > from[other])) continue;
    const double share = (from[other] - a[other]) / (b[other] - a[other]);
    const double distance = sign * (a[axis] + share * (b[axis] - a[axis]) - from[axis]);
    if (distance > -slack && (!nearest || distance < *nearest)) nearest = std::max(0.0, distance);
  }
  return nearest;
}

// The distance to a triangle along a horizontal axis.
std::optional<double> hit(const std::array<Vec3, 3>& corners, const Vec3& from, std::size_t axis,
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
  return distance > -slack ? std::optional(std::max(0.0, distance)) : std::nullopt;
}

class Search {
 public:
  Search(const Scene& scene, const Vec3& unit, std::size_t axis) : scene_(scene), unit_(unit), axis_(axis) {}

  Reference nearest() {
    if (scene_.room) {
      meet_walls(scene_.room->outline);
      for (const Polygon& hole : scene_.room->holes) meet_walls(hole);
    }
    for (const double sign : {-1.0, 1.0}) meet_parts(sign);
    if (!best_ || best_->distance > far_surface)
      for (const double sign : {-1.0, 1.0}) meet_outlines(sign);
    if (best_) return *best_;
    return {axis_ == 0 ? Side::left : Side::bottom, Reference::Kind::origin, "",
            axis_ == 0 ? unit_.x : unit_.y};
  }

 private:
  Vec2 in_plan() const { return {unit_.x, unit_.y}; }

  void offer(double sign, double distance, Reference::Kind kind, const std::string& fixture = {}) {
    if (distance < 0 || (best_ && distance >= best_->distance - slack)) return;
    const Side side =
        axis_ == 0 ? (sign < 0 ? Side::left : Side::right) : (sign < 0 ? Side::bottom : Side::top);
    best_ = Reference{side, kind, fixture, distance};
  }

  void meet_walls(const Polygon& polygon) {
    for (const double sign : {-1.0, 1.0})
      if (const auto distance = crossing(polygon, in_plan(), axis_, sign))
        offer(sign, *distance, Reference::Kind::wall);
  }

  // Surfaces at the height of the unit.
  void meet_parts(double sign) {
    for (const Part& part : scene_.parts) {
      if (part.kind == PartKind::shell || part.fixture >= scene_.fixtures.size()) continue;
      const std::string& id = scene_.fixtures[part.fixture].id;
      if (part.triangle_count > 0) {
        meet_mesh(part, unit_, sign);
      } else if (part.bottom <= unit_.z && unit_.z <= part.top && !contains(part.footprint, in_plan())) {
        if (const auto distance = crossing(part.footprint, in_plan(), axis_, sign))
          offer(sign, *distance, Reference::Kind::fixture, id);
      }
    }
  }

  // Faces of fixtures in plan, at any height: those of meshes at half their height.
  void meet_outlines(double sign) {
    for (const FixtureOutline& fixture : scene_.fixtures) {
      if (fixture.footprint.size() < 3 || fixture.type == "mesh") continue;
      const bool is_below = contains(fixture.footprint, in_plan());
      if (const auto distance = crossing(fixture.footprint, in_plan(), axis_, sign))
        offer(sign, *distance, is_below ? Reference::Kind::end : Reference::Kind::fixture, fixture.id);
    }
    for (const Part& part : scene_.parts)
      meet_mesh(part, {unit_.x, unit_.y, (part.bottom + part.top) / 2}, sign);
  }

  void meet_mesh(const Part& part, const Vec3& from, double sign) {
    if (part.fixture >= scene_.fixtures.size()) return;
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      const auto& [a, b, c] = scene_.mesh.triangles[t];
      const auto& v = scene_.mesh.vertices;
      if (const auto distance = hit({v[a], v[b], v[c]}, from, axis_, sign))
        offer(sign, *distance, Reference::Kind::fixture, scene_.fixtures[part.fixture].id);
    }
  }

  const Scene& scene_;
  const Vec3& unit_;
  std::size_t axis_;
  std::optional<Reference> best_;
};

}  // namespace

std::array<Reference, 2> references_of(const Scene& scene, const Vec3& unit) {
  return {Search(scene, unit, 0).nearest(), Search(scene, unit, 1).nearest()};
}

}  // namespace shelfbeam
