#include "shelfbeam/math/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include <geos_c.h>

namespace shelfbeam {

namespace {

/// A handle of the GEOS library and its geometries, which release themselves.
class Geos {
 public:
  Geos() : handle_(GEOS_init_r()) {
    if (handle_ == nullptr) throw std::bad_alloc();
    GEOSContext_setErrorMessageHandler_r(handle_, keep_message, &message_);
  }
  Geos(const Geos&) = delete;
  Geos& operator=(const Geos&) = delete;
  ~Geos() { GEOS_finish_r(handle_); }

  struct Release {
    GEOSContextHandle_t handle;
    void operator()(GEOSGeometry* geometry) const { GEOSGeom_destroy_r(handle, geometry); }
  };
  using Geometry = std::unique_ptr<GEOSGeometry, Release>;

  GEOSContextHandle_t handle() const { return handle_; }

  Geometry own(GEOSGeometry* geometry) const {
    if (geometry == nullptr) throw std::runtime_error("GEOS: " + message_);
    return {geometry, {handle_}};
  }

  Geometry line(std::span<const Vec2> points, bool closes) const {
    const std::size_t count = points.size() + (closes ? 1 : 0);
    GEOSCoordSequence* sequence = GEOSCoordSeq_create_r(handle_, static_cast<unsigned>(count), 2);
    for (std::size_t k = 0; k < count; ++k) {
      const auto& [x, y] = points[k % points.size()];
      GEOSCoordSeq_setXY_r(handle_, sequence, static_cast<unsigned>(k), x, y);
    }
    return own(closes ? GEOSGeom_createLinearRing_r(handle_, sequence)
                      : GEOSGeom_createLineString_r(handle_, sequence));
  }

  Geometry area(const Polygon& polygon) const {
    Geometry ring = line(polygon, true);
    return own(GEOSGeom_createPolygon_r(handle_, ring.release(), nullptr, 0));
  }

  std::vector<const GEOSGeometry*> members(const Geometry& collection) const {
    std::vector<const GEOSGeometry*> result;
    const int count = GEOSGetNumGeometries_r(handle_, collection.get());
    result.reserve(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k) result.push_back(GEOSGetGeometryN_r(handle_, collection.get(), k));
    return result;
  }

  Vec2 position(const GEOSGeometry* point) const {
    Vec2 at{};
    GEOSGeomGetX_r(handle_, point, at.data());
    GEOSGeomGetY_r(handle_, point, at.data() + 1);
    return at;
  }

  std::vector<Vec2> corners(const GEOSGeometry* area) const {
    const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(handle_, GEOSGetExteriorRing_r(handle_, area));
    unsigned count = 0;
    GEOSCoordSeq_getSize_r(handle_, sequence, &count);
    std::vector<Vec2> points(count - 1);  // without the last, which repeats the first
    for (unsigned k = 0; k + 1 < count; ++k)
      GEOSCoordSeq_getXY_r(handle_, sequence, k, points[k].data(), points[k].data() + 1);
    return points;
  }

 private:
  static void keep_message(const char* text, void* message) { *static_cast<std::string*>(message) = text; }

  GEOSContextHandle_t handle_;
  std::string message_;
};

constexpr double map_grid = 1e-7;  // m

// The first point of other polygons beyond a point of one, in the direction of +x or -x (`sign`).
std::optional<Vec2> beyond(std::span<const Polygon> polygons, std::size_t own, const Vec2& from,
                           double sign) {
  double nearest = HUGE_VAL;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    if (p == own) continue;
    for (std::size_t k = 0; k < polygons[p].size(); ++k) {
      const Vec2 &a = polygons[p][k], &b = polygons[p][(k + 1) % polygons[p].size()];
      if ((a[1] > from[1]) == (b[1] > from[1])) continue;
      const double x = a[0] + (from[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      if (const double way = sign * (x - from[0]); way > -map_grid) nearest = std::min(nearest, way);
    }
  }
  if (nearest <= map_grid || nearest == HUGE_VAL) return {};
  return Vec2{from[0] + sign * nearest, from[1]};
}

// Lines along x. Where many of them cover one another, the union of all lines would take a time that grows
// with their square.
class LevelLines {
 public:
  using Stretch = std::array<double, 2>;  // from one x to another, in either direction

  /// The parts of a new line that no earlier line at its y covers, in its direction.
  std::vector<Stretch> add(const Stretch& line, double y) {
    const auto [low, high] = std::minmax(line[0], line[1]);
    std::map<double, double>& covered = covered_[std::llround(y / map_grid)];  // by low end: high end
    std::vector<Stretch> parts;
    double from = low, end = high;
    auto next = covered.upper_bound(low);
    if (next != covered.begin() && std::prev(next)->second >= low) --next;
    double begin = low;
    while (next != covered.end() && next->first <= high) {
      if (next->first > from) parts.push_back({from, next->first});
      from = std::max(from, next->second);
      begin = std::min(begin, next->first);
      end = std::max(end, next->second);
      next = covered.erase(next);
    }
    if (from < high) parts.push_back({from, high});
    covered.emplace(begin, end);
    if (line[0] > line[1]) {
      std::reverse(parts.begin(), parts.end());
      for (auto& [a, b] : parts) std::swap(a, b);
    }
    return parts;
  }

 private:
  std::map<long long, std::map<double, double>> covered_;
};

class Mapper {
 public:
  PlanarMap map(std::span<const Polygon> polygons, std::span<const std::array<Vec2, 2>> lines) {
    std::vector<GEOSGeometry*> edges;
    const auto draw = [&](std::span<const Vec2> points, bool closes) {
      edges.push_back(geos_.line(points, closes).release());
    };
    for (const Polygon& polygon : polygons) draw(polygon, true);
    for (const auto& line : lines) draw(line, false);
    // Lines from the sides of each polygon connect it with its surroundings, so that no face has a hole:
    // GEOS 3.11 cannot triangulate faces whose holes touch each other.
    LevelLines connections;
    const auto connect = [&](const Vec2& from, const std::optional<Vec2>& end) {
      if (!end) return;
      for (const auto& [begin, stop] : connections.add({from[0], (*end)[0]}, from[1]))
        draw(std::array{Vec2{begin, from[1]}, Vec2{stop, from[1]}}, false);
    };
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      const auto [low, high] = std::minmax_element(polygons[p].begin(), polygons[p].end());
      connect(*low, beyond(polygons, p, *low, -1));
      connect(*high, beyond(polygons, p, *high, 1));
    }
    const auto drawn = geos_.own(GEOSGeom_createCollection_r(
        geos_.handle(), GEOS_GEOMETRYCOLLECTION, edges.data(), static_cast<unsigned>(edges.size())));
    // The union of lines has a vertex wherever two of them meet. On a grid, a corner beside a line by
    // rounding becomes a vertex of the line, so there are no slivers between the two.
    const auto noded = geos_.own(GEOSUnaryUnionPrec_r(geos_.handle(), drawn.get(), map_grid));
    const GEOSGeometry* input = noded.get();
    const auto faces = geos_.own(GEOSPolygonize_r(geos_.handle(), &input, 1));
    for (const GEOSGeometry* face : geos_.members(faces)) add_face(face);
    return std::move(map_);
  }

  PlanarMap map(const Polygon& polygon) {
    add_face(geos_.area(polygon).get());
    return std::move(map_);
  }

 private:
  void add_face(const GEOSGeometry* face) {
    const auto inside = geos_.own(GEOSPointOnSurface_r(geos_.handle(), face));
    const auto triangles = geos_.own(GEOSConstrainedDelaunayTriangulation_r(geos_.handle(), face));
    const std::size_t first = map_.triangles.size();
    double area = 0;
    for (const GEOSGeometry* triangle : geos_.members(triangles)) {
      const std::vector<Vec2> corners = geos_.corners(triangle);
      area += signed_area(corners);
      map_.triangles.push_back({index(corners[0]), index(corners[1]), index(corners[2])});
      map_.face_of.push_back(static_cast<std::uint32_t>(map_.inside.size()));
    }
    // All have the same direction; that of a thin one alone would depend on rounding.
    if (area < 0)
      for (std::size_t t = first; t < map_.triangles.size(); ++t)
        std::swap(map_.triangles[t][1], map_.triangles[t][2]);
    map_.inside.push_back(geos_.position(inside.get()));
  }

  std::uint32_t index(const Vec2& point) {
    const auto [found, is_new] = index_.emplace(point, static_cast<std::uint32_t>(map_.points.size()));
    if (is_new) map_.points.push_back(point);
    return found->second;
  }

  Geos geos_;
  PlanarMap map_;
  std::map<Vec2, std::uint32_t> index_;
};

double distance_to_edge(std::span<const Vec2> polygon, std::size_t k, const Vec2& point) {
  const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
  const double x = b[0] - a[0], y = b[1] - a[1], squared = x * x + y * y;
  const double along = squared > 0 ? ((point[0] - a[0]) * x + (point[1] - a[1]) * y) / squared : 0;
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(point[0] - a[0] - share * x, point[1] - a[1] - share * y);
}

}  // namespace

std::optional<PolygonFault> fault_of(const Polygon& polygon) {
  constexpr double shortest = 1e-4, least = 1e-6;  // m, m^2
  if (polygon.size() < 3)
    return PolygonFault{"has fewer than three corners", polygon.empty() ? Vec2{} : polygon.front(),
                        "give all its corners in order"};
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if (a == b)
      return PolygonFault{"has two equal consecutive corners", a,
                          "remove one of them; the last corner need not repeat the first"};
    if (std::hypot(b[0] - a[0], b[1] - a[1]) < shortest)
      return PolygonFault{"has two consecutive corners less than 0.1 mm apart", a, "remove one of them"};
  }
  const Geos geos;
  const auto area = geos.area(polygon);
  GEOSGeometry* place = nullptr;
  const char valid = GEOSisValidDetail_r(geos.handle(), area.get(), 0, nullptr, &place);
  if (valid == 1) {
    if (std::abs(signed_area(polygon)) >= least) return {};
    return PolygonFault{"has an area below 1 mm^2", polygon.front(), "correct its corners"};
  }
  const auto at = geos.own(place);
  return PolygonFault{"crosses or touches itself", geos.position(at.get()),
                      "give the corners in order, with edges that do not cross"};
}

double overlap_depth(std::span<const Vec2> one, std::span<const Vec2> other) {
  const auto extent = [](std::span<const Vec2> polygon, double x, double y) {
    std::array<double, 2> ends{HUGE_VAL, -HUGE_VAL};
    for (const Vec2& q : polygon) {
      const double along = x * q[0] + y * q[1];
      ends = {std::min(ends[0], along), std::max(ends[1], along)};
    }
    return ends;
  };
  double smallest = HUGE_VAL;
  for (const auto& polygon : {one, other})
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      const double x = a[1] - b[1], y = b[0] - a[0], edge = std::hypot(x, y);
      if (!(edge > 0)) continue;
      const auto mine = extent(one, x / edge, y / edge), theirs = extent(other, x / edge, y / edge);
      smallest = std::min(smallest, std::min(mine[1], theirs[1]) - std::max(mine[0], theirs[0]));
    }
  return smallest;
}

bool overlap(std::span<const Vec2> one, std::span<const Vec2> other) {
  constexpr double rounding = 1e-9;  // m
  return overlap_depth(one, other) > rounding;
}

bool is_convex(const Polygon& polygon) {
  constexpr double rounding = 1e-9;  // m^2
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()],
               &c = polygon[(k + 2) % polygon.size()];
    if ((b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) < -rounding) return false;
  }
  return true;
}

double signed_area(std::span<const Vec2> polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

bool contains(std::span<const Vec2> polygon, const Vec2& point) {
  bool is_inside = false;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((a[1] > point[1]) == (b[1] > point[1])) continue;
    if (point[0] < a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) is_inside = !is_inside;
  }
  return is_inside;
}

double distance_to_border(std::span<const Vec2> polygon, const Vec2& point) {
  double nearest = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    nearest = std::min(nearest, distance_to_edge(polygon, k, point));
  return nearest;
}

std::size_t nearest_edge(std::span<const Vec2> polygon, const Vec2& point) {
  std::size_t nearest = 0;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (const double distance = distance_to_edge(polygon, k, point); distance < least) {
      least = distance;
      nearest = k;
    }
  return nearest;
}

PlanBounds bounds_of(std::span<const Vec2> polygon) {
  PlanBounds bounds;
  for (const Vec2& corner : polygon)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      bounds.low[axis] = std::min(bounds.low[axis], corner[axis]);
      bounds.high[axis] = std::max(bounds.high[axis], corner[axis]);
    }
  return bounds;
}

double shared_area(const Polygon& a, const Polygon& b) {
  if (!bounds_of(a).meets(bounds_of(b))) return 0;
  const Geos geos;
  const auto first = geos.area(a), second = geos.area(b);
  const auto both = geos.own(GEOSIntersection_r(geos.handle(), first.get(), second.get()));
  double area = 0;
  GEOSArea_r(geos.handle(), both.get(), &area);
  return area;
}

PlanarMap triangulated(const Polygon& polygon) {
  return Mapper().map(polygon);
}

PlanarMap planar_map(std::span<const Polygon> polygons, std::span<const std::array<Vec2, 2>> lines) {
  return Mapper().map(polygons, lines);
}

}  // namespace shelfbeam
