#include "shelfbeam/scene/plan_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

namespace {

using Line = std::array<Vec2, 2>;

constexpr double rounding = 1e-6;  // m

double perimeter_of(const Polygon& polygon) {
  double sum = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    sum += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  return sum;
}

// The edges of a border whose bounds meet those of the plan.
void add_edges(const Polygon& border, const PlanBounds& bounds, std::vector<Line>& lines) {
  for (std::size_t k = 0; k < border.size(); ++k) {
    const Line edge{border[k], border[(k + 1) % border.size()]};
    if (bounds_of(edge).meets(bounds)) lines.push_back(edge);
  }
}

PlanPart part_around(const RoomShape& shape, const Vec2& inside) {
  PlanPart part;
  if (shape.covers(inside)) part.ceiling = &shape.ceiling_over(inside);
  return part;
}

}  // namespace

std::vector<PlanPart> plan_parts(const RoomShape& shape, const Polygon& polygon) {
  const double negligible = rounding * perimeter_of(polygon);
  if (!(std::abs(signed_area(polygon)) > negligible)) return {};
  const PlanBounds bounds = bounds_of(polygon);
  std::vector<Line> lines;
  add_edges(shape.outline, bounds, lines);
  for (const Polygon& hole : shape.holes) add_edges(hole, bounds, lines);
  for (const CeilingZone& zone : shape.zones) add_edges(zone.polygon, bounds, lines);
  if (lines.empty()) {
    PlanPart whole = part_around(shape, polygon.front());
    whole.points = polygon;
    return {std::move(whole)};
  }

  const PlanarMap map = planar_map(std::array{polygon}, lines);
  std::vector<PlanPart> parts(map.inside.size());
  std::vector<double> areas(map.inside.size());
  for (std::size_t f = 0; f < parts.size(); ++f)
    if (contains(polygon, map.inside[f])) parts[f] = part_around(shape, map.inside[f]);
  for (std::size_t t = 0; t < map.triangles.size(); ++t) {
    const std::uint32_t face = map.face_of[t];
    std::array<Vec2, 3> corners{};
    for (std::size_t k = 0; k < corners.size(); ++k) corners[k] = map.points[map.triangles[t][k]];
    parts[face].points.insert(parts[face].points.end(), corners.begin(), corners.end());
    areas[face] += signed_area(corners);
  }
  std::vector<PlanPart> kept;
  for (std::size_t f = 0; f < parts.size(); ++f)
    if (areas[f] > negligible && contains(polygon, map.inside[f])) kept.push_back(std::move(parts[f]));
  return kept;
}

bool leave_room(const std::vector<PlanPart>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [](const PlanPart& part) { return part.ceiling == nullptr; });
}

bool is_within_room(const RoomShape& shape, const Polygon& polygon, double top) {
  const std::vector<PlanPart> parts = plan_parts(shape, polygon);
  return !leave_room(parts) && lowest_ceiling(parts) >= top;
}

double lowest_ceiling(const std::vector<PlanPart>& parts) {
  double lowest = HUGE_VAL;
  for (const PlanPart& part : parts)
    if (part.ceiling != nullptr)
      for (const Vec2& p : part.points) lowest = std::min(lowest, part.ceiling->at(p));
  return lowest;
}

}  // namespace shelfbeam
