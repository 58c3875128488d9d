#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

/// Calls `use(begin, end)` for every edge of a polygon, in the order of its corners.
template <class Use>
void each_edge(const Polygon& polygon, Use use) {
  for (std::size_t k = 0; k < polygon.size(); ++k) use(polygon[k], polygon[(k + 1) % polygon.size()]);
}

inline double distance(const Vec2& p, const Vec2& q) {
  return std::hypot(q[0] - p[0], q[1] - p[1]);
}

/// The point of the edge from a to b that is nearest to p.
inline Vec2 nearest_point(const Vec2& a, const Vec2& b, const Vec2& p) {
  const double x = b[0] - a[0], y = b[1] - a[1], squared = x * x + y * y;
  const double along = squared > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / squared : 0;
  const double share = std::clamp(along, 0.0, 1.0);
  return {a[0] + share * x, a[1] + share * y};
}

}  // namespace shelfbeam
