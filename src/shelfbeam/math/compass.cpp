#include "shelfbeam/math/compass.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/math/polygon.hpp"
#include "shelfbeam/math/polygon_edges.hpp"

namespace shelfbeam {

namespace {

// An edge between two directions, apart from rounding, belongs to neither.
bool looks_towards(const Vec2& normal, Compass direction) {
  constexpr double rounding = 1e-9;
  const auto [x, y] = vector_of(direction);
  return x * normal[0] + y * normal[1] > std::sqrt(0.5) + rounding;
}

}  // namespace

std::vector<Vec2> outward_normals(const Polygon& polygon) {
  const double side = signed_area(polygon) > 0 ? 1 : -1;
  std::vector<Vec2> normals;
  each_edge(polygon, [&](const Vec2& from, const Vec2& to) {
    const double x = to[0] - from[0], y = to[1] - from[1], extent = std::hypot(x, y);
    normals.push_back({side * y / extent, -side * x / extent});
  });
  return normals;
}

std::vector<std::vector<std::size_t>> edges_towards(const Polygon& polygon, Compass direction) {
  std::vector<bool> looks;
  for (const Vec2& normal : outward_normals(polygon)) looks.push_back(looks_towards(normal, direction));
  // Behind an edge of another direction, because a run may cross the end of the list.
  const auto other = static_cast<std::size_t>(std::find(looks.begin(), looks.end(), false) - looks.begin());
  std::vector<std::vector<std::size_t>> runs;
  bool is_in_run = false;
  for (std::size_t n = 1; n <= polygon.size(); ++n) {
    const std::size_t k = (other + n) % polygon.size();
    if (looks[k] && !is_in_run) runs.emplace_back();
    if (looks[k]) runs.back().push_back(k);
    is_in_run = looks[k];
  }
  return runs;
}

}  // namespace shelfbeam
