#include "shelfbeam/scene/mesh/gltf_placement.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace shelfbeam {

GltfPlacement GltfPlacement::from(const Vec3& translation, const std::array<double, 4>& rotation,
                                  const Vec3& scale) {
  auto [x, y, z, w] = rotation;
  constexpr double rounding = 1e-5;  // beyond that of single precision
  double square = x * x + y * y + z * z + w * w;
  if (!std::isnormal(square)) {  // overflow or underflow
    const double largest = std::max({std::abs(x), std::abs(y), std::abs(z), std::abs(w)});
    x /= largest;
    y /= largest;
    z /= largest;
    w /= largest;
    square = x * x + y * y + z * z + w * w;
  }
  if (std::abs(square - 1) > rounding) {
    const double factor = 1 / std::sqrt(square);
    x *= factor;
    y *= factor;
    z *= factor;
    w *= factor;
  }
  return {Vec3{1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)} * scale.x,
          Vec3{2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)} * scale.y,
          Vec3{2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)} * scale.z, translation};
}

GltfPlacement GltfPlacement::from_matrix(const double* m, const JsonCursor& place) {
  constexpr double rounding = 1e-6;
  if (!(std::abs(m[3]) + std::abs(m[7]) + std::abs(m[11]) + std::abs(m[15] - 1) < rounding))
    place.fail("has a last row other than 0, 0, 0, 1", "export the file again");
  return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
}

GltfPlacement GltfPlacement::of_node(const JsonCursor& node) {
  if (const auto matrix = node.find("matrix")) return from_matrix(matrix->numbers(16).data(), *matrix);
  const auto vector_at = [&](const char* key, double otherwise) {
    const auto found = node.find(key);
    if (!found) return Vec3{otherwise, otherwise, otherwise};
    const auto v = found->numbers(3);
    return Vec3{v[0], v[1], v[2]};
  };
  std::array<double, 4> rotation{0, 0, 0, 1};
  if (const auto found = node.find("rotation")) {
    const auto q = found->numbers(4);
    std::copy(q.begin(), q.end(), rotation.begin());
    if (q == std::vector<double>(4, 0)) found->fail("is a zero quaternion", "export the file again");
  }
  return from(vector_at("translation", 0), rotation, vector_at("scale", 1));
}

}  // namespace shelfbeam
