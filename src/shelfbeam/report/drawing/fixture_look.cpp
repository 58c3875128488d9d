#include "shelfbeam/report/drawing/fixture_look.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

constexpr double section_height = 1.2;            // m
constexpr std::uint32_t max_triangles = 200'000;  // per part, in a section
constexpr double large_share = 0.3;               // of the floor

struct Bounds {
  Span x, y;

  explicit Bounds(std::span<const Vec2> polygon) {
    for (const auto& [px, py] : polygon) {
      x.add(px);
      y.add(py);
    }
  }
  double area() const { return x.size() * y.size(); }
  bool contains(const Bounds& other) const {
    return x.low <= other.x.low && other.x.high <= x.high && y.low <= other.y.low && other.y.high <= y.high;
  }
};

double bottom_of(const Scene& scene, std::uint32_t fixture) {
  double bottom = std::numeric_limits<double>::infinity();
  for (const Part& part : scene.parts)
    if (part.fixture == fixture && part.kind != PartKind::shell) bottom = std::min(bottom, part.bottom);
  return std::isfinite(bottom) ? bottom : 0;
}

// The line in which a plane of constant height cuts a triangle, as path data.
std::string cut(const PlanView& view, const std::array<Vec3, 3>& corners, double z) {
  std::vector<Point> ends;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vec3 &a = corners[k], &b = corners[(k + 1) % corners.size()];
    if ((a.z > z) == (b.z > z)) continue;
    const double share = (z - a.z) / (b.z - a.z);
    ends.push_back(view.at(a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)));
  }
  if (ends.size() != 2) return {};
  return fmt::format("M{} {}L{} {}", coordinate(ends[0].x), coordinate(ends[0].y), coordinate(ends[1].x),
                     coordinate(ends[1].y));
}

}  // namespace

std::vector<Look> looks_of(const Scene& scene) {
  const Vec3 size = scene.room ? *scene.room : scene.upper - scene.lower;
  std::vector<Look> looks;
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f) {
    const FixtureOutline& fixture = scene.fixtures[f];
    if (bottom_of(scene, f) >= head_height) {
      looks.push_back(Look::overhead);
      continue;
    }
    const Bounds own(fixture.footprint);
    const auto is_inside = [&](const FixtureOutline& other) {
      return &other != &fixture && other.footprint.size() > 2 && other.height <= fixture.height &&
             own.contains(Bounds(other.footprint));
    };
    const bool covers = fixture.footprint.size() > 2 &&
                        (own.area() > large_share * size.x * size.y ||
                         std::any_of(scene.fixtures.begin(), scene.fixtures.end(), is_inside));
    looks.push_back(covers ? Look::covering : Look::solid);
  }
  return looks;
}

std::vector<std::uint32_t> fixtures_by_height(const Scene& scene) {
  std::vector<std::uint32_t> order;
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f)
    if (scene.fixtures[f].footprint.size() > 2) order.push_back(f);
  std::stable_sort(order.begin(), order.end(),
                   [&](auto a, auto b) { return scene.fixtures[a].height < scene.fixtures[b].height; });
  return order;
}

std::string mesh_section(const PlanView& view, const Scene& scene, std::uint32_t fixture) {
  std::string data;
  for (const Part& part : scene.parts) {
    if (part.fixture != fixture || part.triangle_count == 0 || part.triangle_count > max_triangles) continue;
    const bool is_cut = part.bottom < section_height && section_height < part.top;
    const double z = is_cut ? section_height : (part.bottom + part.top) / 2;
    for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
      const auto& [a, b, c] = scene.mesh.triangles[t];
      data += cut(view, {scene.mesh.vertices[a], scene.mesh.vertices[b], scene.mesh.vertices[c]}, z);
    }
  }
  return data;
}

}  // namespace shelfbeam
