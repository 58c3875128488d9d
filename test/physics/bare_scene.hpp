#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::test {

inline Vec3 lowest(const Vec3& a, const Vec3& b) {
  return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
}
inline Vec3 highest(const Vec3& a, const Vec3& b) {
  return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// A hand-made scene without room or store file. Every label and unit has its own type.
struct BareScene {
  Scene scene;

  MaterialId material(Material surface) {
    const MaterialId id{static_cast<std::uint32_t>(scene.materials.size())};
    scene.materials.push_back({"m" + std::to_string(id.value), std::move(surface)});
    return id;
  }

  void triangle(MaterialId surface, const std::array<Vec3, 3>& corners) {
    const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    if (first == 0) scene.lower = scene.upper = corners[0];
    for (const Vec3& p : corners) {
      scene.lower = lowest(scene.lower, p);
      scene.upper = highest(scene.upper, p);
      scene.mesh.vertices.push_back(p);
    }
    scene.mesh.triangles.push_back({first, first + 1, first + 2});
    scene.mesh.materials.push_back(surface);
  }

  /// A parallelogram with the normal `right` x `up`.
  void quad(MaterialId surface, const Vec3& corner, const Vec3& right, const Vec3& up) {
    triangle(surface, {corner, corner + right, corner + right + up});
    triangle(surface, {corner, corner + right + up, corner + up});
  }

  /// The six sides of an axis-aligned box with outward normals: floor, ceiling and walls.
  void box(const std::array<MaterialId, 3>& surfaces, const Vec3& low, const Vec3& high) {
    const Vec3 x{high.x - low.x, 0, 0}, y{0, high.y - low.y, 0}, z{0, 0, high.z - low.z};
    quad(surfaces[0], low, y, x);
    quad(surfaces[1], low + z, x, y);
    quad(surfaces[2], low, x, z);
    quad(surfaces[2], low + y, z, x);
    quad(surfaces[2], low, z, y);
    quad(surfaces[2], low + x, y, z);
  }
  void box(MaterialId surface, const Vec3& low, const Vec3& high) {
    box({surface, surface, surface}, low, high);
  }

  /// An icosahedron about the origin, each triangle divided into four `level` times, with corners on the
  /// sphere.
  void sphere(MaterialId surface, double radius, int level) {
    const double g = (1 + std::sqrt(5.0)) / 2;
    const std::vector<Vec3> corners{{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                    {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                    {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    constexpr std::array<std::array<std::size_t, 3>, 20> faces{
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
    for (const auto& [a, b, c] : faces)
      refine(surface, radius, level,
             {normalized(corners[a]), normalized(corners[b]), normalized(corners[c])});
  }

  void label(const Vec3& position, const Vec3& normal, const Responsivity& responsivity = CosineResponse{},
             std::array<double, 2> size = {}) {
    LabelType type;
    type.name = "label type " + std::to_string(scene.labels.size());
    type.responsivity = responsivity;
    type.size = size;
    scene.label_types.push_back(type);
    scene.labels.push_back({"L" + std::to_string(scene.labels.size()), position, normal,
                            LabelTypeId{static_cast<std::uint32_t>(scene.labels.size())}});
  }

  void unit(const Vec3& position, const Vec3& axis, const Emission& emission, double radius = 0) {
    const auto index = static_cast<std::uint32_t>(scene.transceivers.size());
    scene.transceiver_types.push_back({"unit type " + std::to_string(index), emission, radius, 1});
    scene.transceivers.push_back(
        {"T" + std::to_string(index), position, axis, 0, TransceiverTypeId{index}, false});
  }

  void shines(MaterialId surface, double radiance) {
    scene.emitting_surfaces.push_back(
        {"S" + std::to_string(scene.emitting_surfaces.size()), surface, radiance});
  }

  double mesh_area() const {
    double area = 0;
    for (const auto& [a, b, c] : scene.mesh.triangles)
      area += length(cross(scene.mesh.vertices[b] - scene.mesh.vertices[a],
                           scene.mesh.vertices[c] - scene.mesh.vertices[a])) /
              2;
    return area;
  }

 private:
  void refine(MaterialId surface, double radius, int level, const std::array<Vec3, 3>& p) {
    if (level == 0) return triangle(surface, {p[0] * radius, p[1] * radius, p[2] * radius});
    const Vec3 a = normalized(p[0] + p[1]), b = normalized(p[1] + p[2]), c = normalized(p[2] + p[0]);
    refine(surface, radius, level - 1, {p[0], a, c});
    refine(surface, radius, level - 1, {a, p[1], b});
    refine(surface, radius, level - 1, {c, b, p[2]});
    refine(surface, radius, level - 1, {a, b, c});
  }
};

}  // namespace shelfbeam::test
