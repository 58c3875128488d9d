#include "shelfbeam/transport/cells/cell_division.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "shelfbeam/transport/cells/cell_grid.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double height = 0.02;    // m above the surface, where points look at each other
constexpr double margin = 0.0005;  // m from a plane to the points that it separates

Vec3 above(const SurfacePoint& point) {
  return point.position + height * point.normal;
}

bool contains(const Bounds& box, const Vec3& p) {
  return p.x >= box.low.x && p.y >= box.low.y && p.z >= box.low.z && p.x < box.high.x && p.y < box.high.y &&
         p.z < box.high.z;
}

double side(const CellDivision::Plane& plane, const SurfacePoint& point) {
  return dot(plane.normal, above(point)) - plane.offset;
}

// The plane of the surface that hides one point from another, if it lies between them.
std::optional<CellDivision::Plane> between(const World& world, const SurfacePoint& a, const SurfacePoint& b) {
  const Vec3 from = above(a), way = above(b) - from;
  const double distance = length(way);
  if (!(distance > margin)) return std::nullopt;
  const auto hit = world.rays.intersect({from, way / distance}, way / distance);
  if (!hit || is_pane(world.material(*hit)) || hit->distance(from, way / distance) >= distance)
    return std::nullopt;
  const CellDivision::Plane plane{hit->point.normal, dot(hit->point.normal, hit->point.position), {}};
  const double here = side(plane, a), there = side(plane, b);
  if (here * there > 0 || std::min(std::abs(here), std::abs(there)) < margin) return std::nullopt;
  return plane;
}

std::optional<CellDivision::Plane> wall_between(const World& world, const std::vector<SurfacePoint>& points) {
  constexpr std::size_t looks = 16;
  const std::size_t step = (points.size() + looks - 1) / looks;
  for (std::size_t k = step; k < points.size(); k += step)
    if (const auto plane = between(world, points[0], points[k])) return plane;
  return std::nullopt;
}

std::size_t points_above(const CellDivision::Plane& plane, const std::vector<SurfacePoint>& points) {
  return static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [&](const SurfacePoint& p) { return side(plane, p) > 0; }));
}

// The plane of a surface that a unit lights closely: points behind it do not see this light.
std::optional<CellDivision::Plane> shading_plane(const std::vector<SurfacePoint>& points,
                                                 std::span<const CloseUnit> units) {
  for (const CloseUnit& unit : units) {
    const CellDivision::Plane plane{unit.normal, unit.offset, {}};
    const std::size_t count = points_above(plane, points);
    if (count > 0 && count < points.size()) return plane;
  }
  return std::nullopt;
}

// Adds random points in a box, on the surface that the points are on, as far as the points see them.
void sprinkle(const World& world, const Bounds& box, RandomStream& random,
              std::vector<SurfacePoint>& points) {
  constexpr int tries = 8;
  const std::size_t count = points.size();
  for (int t = 0; t < tries; ++t) {
    const SurfacePoint anchor = points[to_index(random.bits(), static_cast<std::uint32_t>(count))];
    const Vec3 u{random.uniform(), random.uniform(), random.uniform()}, size = box.high - box.low;
    const Vec3 in = box.low + Vec3{u.x * size.x, u.y * size.y, u.z * size.z};
    const SurfacePoint wanted{in - dot(anchor.normal, in - anchor.position) * anchor.normal, anchor.normal};
    if (!contains(box, wanted.position)) continue;
    const Vec3 from = above(wanted);
    if (world.rays.transmittance({above(anchor), anchor.normal}, from).share == 0) continue;
    const auto hit = world.rays.intersect({from, -anchor.normal}, -anchor.normal);
    if (!hit || length(hit->point.position - from) > 2 * height) continue;
    SurfacePoint found = hit->point;
    if (dot(found.normal, anchor.normal) < 0) found.normal = -found.normal;
    if (dot(found.normal, anchor.normal) > 0.9 && contains(box, found.position)) points.push_back(found);
  }
}

// The longest side that a part of a cell should have along an axis. Close to the edge between the lit surface
// and another one, the light changes with the distance from the edge.
double max_side(const Bounds& box, int facing, int axis, std::span<const CloseUnit> units) {
  constexpr double edge = 0.3;                                 // m
  constexpr double per_distance = 11.7, finest_across = 0.54;  // in units of `finest`, the first per metre
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& [place, normal, offset, finest] : units) {
    const Vec3 in{std::clamp(place.x, box.low.x, box.high.x), std::clamp(place.y, box.low.y, box.high.y),
                  std::clamp(place.z, box.low.z, box.high.z)};
    const double distance = length(in - place);
    limit = std::min(limit, finest * std::max(1.0, per_distance * distance));
    if (distance > edge || facing_axis(normal) == facing) continue;
    const double from_edge = std::abs(dot(normal, 0.5 * (box.low + box.high)) - offset);
    limit = std::min(limit, facing_axis(normal) == axis ? std::max(finest_across * finest, from_edge)
                                                        : std::max(finest, 2 * from_edge));
  }
  return limit;
}

// The plane through the middle of a box that is too long, or of its half with points.
std::optional<CellDivision::Plane> halving_plane(const std::vector<SurfacePoint>& points, Bounds box,
                                                 std::span<const CloseUnit> units,
                                                 std::array<Bounds, 2>& halves) {
  if (units.empty()) return std::nullopt;
  const int facing = facing_axis(points[0].normal);
  while (points.size() > 1) {
    const Vec3 size = box.high - box.low, center = 0.5 * (box.low + box.high);
    int axis = -1;
    double most = 1;
    for (int k = 0; k < 3; ++k)
      if (const double excess = k == facing ? 0 : size[k] / max_side(box, facing, k, units); excess > most) {
        most = excess;
        axis = k;
      }
    if (axis < 0) return std::nullopt;
    const auto at = [axis](Vec3& v) -> double& { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; };
    Vec3 normal{};
    at(normal) = 1;
    const CellDivision::Plane plane{normal, center[axis], {}};
    halves[0] = halves[1] = box;
    at(halves[0].high) = at(halves[1].low) = center[axis];
    const std::size_t count = points_above(plane, points);
    if (count > 0 && count < points.size()) return plane;
    box = halves[count > 0 ? 1 : 0];
  }
  return std::nullopt;
}

}  // namespace

CellDivision::CellDivision(const World& world, std::vector<SurfacePoint> points,
                           std::span<const CloseUnit> units, std::uint64_t key)
    : world_(world), key_(key) {
  constexpr double reach = 1.5;  // m
  const Bounds cell = CellGrid::box(CellGrid::cube(CellGrid::scaled(points[0].position)));
  for (const CloseUnit& unit : units)
    if (length_squared(0.5 * (cell.low + cell.high) - unit.position) < reach * reach) units_.push_back(unit);
  divide(std::move(points), cell);
}

std::uint32_t CellDivision::divide(std::vector<SurfacePoint> points, const Bounds& box) {
  const auto add_part = [&] {
    parts_.push_back(std::move(points));
    return static_cast<std::uint32_t>(parts_.size() - 1);
  };
  if (planes_.size() + 1 >= max_parts) return add_part();
  // Small parts leave room for walls.
  const bool may_be_fine = !units_.empty() && planes_.size() + 1 < max_parts / 2;
  std::array<Bounds, 2> boxes{box, box};
  auto plane = wall_between(world_, points);
  if (!plane) plane = shading_plane(points, units_);
  if (!plane && may_be_fine) {
    RandomStream random(key_, static_cast<std::uint32_t>(planes_.size() + parts_.size()), 0, 0xCE11);
    sprinkle(world_, box, random, points);
    std::erase_if(points, [&](const SurfacePoint& point) { return !is_within_path(point); });
    plane = halving_plane(points, box, units_, boxes);
  }
  if (!plane) return add_part();
  const auto number = static_cast<std::uint32_t>(planes_.size());
  planes_.push_back(*plane);
  std::array<std::vector<SurfacePoint>, 2> sides;
  for (const SurfacePoint& point : points) sides[side(*plane, point) > 0 ? 1 : 0].push_back(point);
  for (std::size_t k = 0; k < 2; ++k) {
    path_.emplace_back(number, k == 1);
    const std::uint32_t at = divide(std::move(sides[k]), boxes[k]);
    path_.pop_back();
    planes_[number].sides[k] = at;
  }
  return inner | number;
}

bool CellDivision::is_within_path(const SurfacePoint& point) const {
  return std::all_of(path_.begin(), path_.end(),
                     [&](const auto& step) { return (side(planes_[step.first], point) > 0) == step.second; });
}

// Planes lead to later planes only, so that every way ends at a part.
bool CellDivision::fit(std::span<const Plane> planes) {
  for (std::size_t k = 0; k < planes.size(); ++k)
    for (const std::uint32_t at : planes[k].sides) {
      const bool is_inner = (at & inner) != 0;
      if (is_inner ? (at & ~inner) <= k || (at & ~inner) >= planes.size() : at > planes.size()) return false;
    }
  return true;
}

std::uint32_t CellDivision::part(std::span<const Plane> planes, const SurfacePoint& point) {
  if (planes.empty()) return 0;
  std::uint32_t at = inner;
  while ((at & inner) != 0) {
    const Plane& plane = planes[at & ~inner];
    at = plane.sides[side(plane, point) > 0 ? 1 : 0];
  }
  return at;
}

}  // namespace shelfbeam::detail
