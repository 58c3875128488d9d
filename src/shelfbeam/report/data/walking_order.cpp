#include "shelfbeam/report/data/walking_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace shelfbeam {

namespace {

double way(const Vec3& a, const Vec3& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::vector<std::size_t> nearest_next(std::span<const Vec3> positions, Vec3 at) {
  std::vector<std::size_t> order;
  std::vector<bool> done(positions.size(), false);
  while (order.size() < positions.size()) {
    std::size_t next = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < positions.size(); ++k)
      if (const double distance = way(at, positions[k]); !done[k] && distance < nearest) {
        nearest = distance;
        next = k;
      }
    done[next] = true;
    order.push_back(next);
    at = positions[next];
  }
  return order;
}

}  // namespace

std::vector<std::size_t> walking_order(std::span<const Vec3> positions, const Vec3& start) {
  std::vector<std::size_t> order = nearest_next(positions, start);
  const auto at = [&](std::size_t k) -> const Vec3& { return positions[order[k]]; };
  constexpr double shorter = 1e-9;  // m; less is rounding
  for (bool has_improved = true; has_improved;) {
    has_improved = false;
    for (std::size_t i = 1; i + 1 < order.size(); ++i)
      for (std::size_t j = i + 1; j < order.size(); ++j) {
        const bool is_end = j + 1 == order.size();
        const double before = way(at(i - 1), at(i)) + (is_end ? 0 : way(at(j), at(j + 1)));
        const double after = way(at(i - 1), at(j)) + (is_end ? 0 : way(at(i), at(j + 1)));
        if (after >= before - shorter) continue;
        std::reverse(order.begin() + static_cast<std::ptrdiff_t>(i),
                     order.begin() + static_cast<std::ptrdiff_t>(j) + 1);
        has_improved = true;
      }
  }
  return order;
}

}  // namespace shelfbeam
