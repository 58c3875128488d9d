#include "shelfbeam/scene/mesh/shell_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace shelfbeam {

namespace {

// Twice the area of a, b, p seen along z. The same edge of two triangles gives values that differ in sign
// only, so that no ray passes between them.
double turn(const Vec3& a, const Vec3& b, const Vec3& p) {
  const auto from = [&](const Vec3& u, const Vec3& v) {
    return (v.x - u.x) * (p.y - u.y) - (v.y - u.y) * (p.x - u.x);
  };
  return std::tie(a.x, a.y) < std::tie(b.x, b.y) ? from(a, b) : -from(b, a);
}

}  // namespace

ShellCrossings::ShellCrossings(const std::vector<SolidTriangle>& triangles, double contact)
    : contact_(contact), index_([&] {
        std::vector<Bounds> boxes;
        for (const SolidTriangle& triangle : triangles) {
          auto& corners = corners_.emplace_back();
          Bounds box;
          for (std::size_t k = 0; k < 3; ++k) {
            corners[k] = turned(triangle.corners[k]);
            box.include(corners[k]);
          }
          boxes.push_back(box);
        }
        return boxes;
      }()) {}

Vec3 ShellCrossings::turned(const Vec3& p) {
  static const Vec3 z = normalized({0.3170, 0.2089, 0.9252});
  static const Vec3 x = normalized(cross({0.6431, 0.7519, 0.1447}, z));
  static const Vec3 y = cross(z, x);
  return {dot(x, p), dot(y, p), dot(z, p)};
}

bool ShellCrossings::faces_along(std::uint32_t triangle) const {
  const auto& [a, b, c] = corners_[triangle];
  return cross(b - a, c - a).z > 0;
}

ShellCrossings::Meeting ShellCrossings::meeting_of(std::uint32_t triangle, const Vec3& start) const {
  const auto& [a, b, c] = corners_[triangle];
  const double toward_a = turn(b, c, start), toward_b = turn(c, a, start), toward_c = turn(a, b, start);
  const bool is_over = (toward_a > 0) == (toward_b > 0) && (toward_b > 0) == (toward_c > 0);
  const double area = toward_a + toward_b + toward_c;
  if (!is_over || area == 0) return Meeting::none;
  const double height = (toward_a * a.z + toward_b * b.z + toward_c * c.z) / area - start.z;
  const Vec3 normal = cross(b - a, c - a);
  if (std::abs(height * normal.z) <= contact_ * length(normal)) return Meeting::on;
  return height > 0 ? Meeting::ahead : Meeting::none;
}

}  // namespace shelfbeam
