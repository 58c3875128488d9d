#include "shelfbeam/scene/plan_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shelfbeam/math/polygon_edges.hpp"

namespace shelfbeam {

namespace {

using Line = std::array<Vec2, 2>;

constexpr double outline_rounding = 1e-6;  // m

double perimeter_of(const Polygon& polygon) {
  double sum = 0;
  each_edge(polygon, [&](const Vec2& a, const Vec2& b) { sum += std::hypot(b[0] - a[0], b[1] - a[1]); });
  return sum;
}

// The edges of a border whose bounds meet those of the plan.
void add_edges(const Polygon& border, const PlanBounds& bounds, std::vector<Line>& lines) {
  each_edge(border, [&](const Vec2& a, const Vec2& b) {
    if (bounds_of(Line{a, b}).meets(bounds)) lines.push_back({a, b});
  });
}

PlanPart part_around(const RoomShape& shape, const Vec2& inside) {
  PlanPart part;
  if (shape.covers(inside)) part.ceiling = &shape.ceiling_over(inside);
  return part;
}

/// Whether a block is within the room, as far as single points and edges decide. That takes a small part of
/// the time of dividing the plan.
class RoomFit {
 public:
  RoomFit(const RoomShape& shape, const Polygon& polygon, double top)
      : shape_(shape),
        polygon_(polygon),
        top_(top),
        bounds_(bounds_of(polygon)),
        // So far inside, dividing the plan comes to the same result.
        inset_(3 * std::sqrt(outline_rounding * perimeter_of(polygon))) {
    meets_low_ceiling_ = is_low(shape.height) ||
                         std::any_of(shape.zones.begin(), shape.zones.end(), [&](const CeilingZone& zone) {
                           return is_low(zone.height) && bounds_of(zone.polygon).meets(bounds_);
                         });
  }

  bool meets_low_ceiling() const { return meets_low_ceiling_; }

  std::optional<bool> certain() const {
    if (!(signed_area(polygon_) > 0) || !is_convex(polygon_)) return {};
    Vec2 middle{};
    for (const auto& [x, y] : polygon_) {
      middle[0] += x / static_cast<double>(polygon_.size());
      middle[1] += y / static_cast<double>(polygon_.size());
    }
    if (is_empty(stretch_within({middle, middle}, inset_))) return {};  // too narrow
    if (is_outside(middle)) return false;
    for (const auto& [x, y] : polygon_) {
      const double share = 1 - 3 * inset_ / std::hypot(x - middle[0], y - middle[1]);
      if (share > 0 && is_outside({middle[0] + share * (x - middle[0]), middle[1] + share * (y - middle[1])}))
        return false;
    }
    bool touches = false, leaves = meet(shape_.outline, touches);
    for (const Polygon& hole : shape_.holes) leaves = leaves || meet(hole, touches);
    if (meets_low_ceiling_)
      for (const CeilingZone& zone : shape_.zones) leaves = leaves || meet(zone.polygon, touches);
    if (leaves) return false;
    if (touches) return {};
    return !meets_low_ceiling_ || !is_low(shape_.ceiling_over(middle));
  }

 private:
  bool is_low(const CeilingHeight& ceiling) const {
    return std::any_of(polygon_.begin(), polygon_.end(), [&](const Vec2& p) { return ceiling.at(p) < top_; });
  }

  bool is_outside(const Vec2& p) const {
    return !shape_.covers(p) ||
           (meets_low_ceiling_ && shape_.ceiling_over(p).at(p) < top_ - outline_rounding);
  }

  // The stretch of a line, by shares of it, within the polygon with its sides moved inwards. Precondition:
  // the polygon is convex and counter-clockwise.
  std::array<double, 2> stretch_within(const Line& line, double inset) const {
    constexpr double parallel = 1e-12;
    const auto& [from, to] = line;
    double begin = 0, end = 1;
    for (std::size_t k = 0; k < polygon_.size(); ++k) {
      const Vec2 &a = polygon_[k], &b = polygon_[(k + 1) % polygon_.size()];
      const double x = b[0] - a[0], y = b[1] - a[1], edge = std::hypot(x, y);
      if (!(edge > 0)) continue;
      const double distance = (x * (from[1] - a[1]) - y * (from[0] - a[0])) / edge - inset;
      const double slope = (x * (to[1] - from[1]) - y * (to[0] - from[0])) / edge;
      if (std::abs(slope) < parallel)
        end = distance > 0 ? end : -1;
      else if (slope > 0)
        begin = std::max(begin, -distance / slope);
      else
        end = std::min(end, -distance / slope);
    }
    return {begin, end};
  }
  static bool is_empty(const std::array<double, 2>& stretch) { return !(stretch[0] < stretch[1]); }

  // Whether the block extends beyond an edge of a border. Sets `touches` if it comes near one.
  bool meet(const Polygon& border, bool& touches) const {
    constexpr double near = 1e-3;  // m
    for (std::size_t k = 0; k < border.size(); ++k) {
      const Line edge{border[k], border[(k + 1) % border.size()]};
      PlanBounds bounds = bounds_of(edge);
      for (std::size_t axis = 0; axis < 2; ++axis) {
        bounds.low[axis] -= near;
        bounds.high[axis] += near;
      }
      if (!bounds.meets(bounds_) || is_empty(stretch_within(edge, -near))) continue;
      touches = true;
      const auto [begin, end] = stretch_within(edge, 2 * inset_);
      if (!(begin < end)) continue;
      const auto& [a, b] = edge;
      const double x = b[0] - a[0], y = b[1] - a[1], half = (begin + end) / 2,
                   step = inset_ / std::hypot(x, y);
      const Vec2 p{a[0] + half * x, a[1] + half * y};
      if (is_outside({p[0] - step * y, p[1] + step * x}) || is_outside({p[0] + step * y, p[1] - step * x}))
        return true;
    }
    return false;
  }

  const RoomShape& shape_;
  const Polygon& polygon_;
  double top_;
  PlanBounds bounds_;
  double inset_;
  bool meets_low_ceiling_ = false;
};

}  // namespace

std::vector<PlanPart> plan_parts(const RoomShape& shape, const Polygon& polygon) {
  const double negligible = outline_rounding * perimeter_of(polygon);
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

RoomShape walls_of(const RoomShape& shape) {
  RoomShape walls;
  walls.outline = shape.outline;
  walls.holes = shape.holes;
  return walls;
}

bool leave_room(const std::vector<PlanPart>& parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [](const PlanPart& part) { return part.ceiling == nullptr; });
}

bool is_within_room(const RoomShape& shape, const Polygon& polygon, double top) {
  const RoomFit fit(shape, polygon, top);
  if (const auto certain = fit.certain()) return *certain;
  const std::vector<PlanPart> parts =
      fit.meets_low_ceiling() ? plan_parts(shape, polygon) : plan_parts(walls_of(shape), polygon);
  return !leave_room(parts) && (!fit.meets_low_ceiling() || lowest_ceiling(parts) >= top);
}

double lowest_ceiling(const std::vector<PlanPart>& parts) {
  double lowest = HUGE_VAL;
  for (const PlanPart& part : parts)
    if (part.ceiling != nullptr)
      for (const Vec2& p : part.points) lowest = std::min(lowest, part.ceiling->at(p));
  return lowest;
}

}  // namespace shelfbeam
