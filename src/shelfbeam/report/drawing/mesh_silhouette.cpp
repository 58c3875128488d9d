#include "shelfbeam/report/drawing/mesh_silhouette.hpp"

#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

constexpr std::uint32_t most_triangles = 2000;  // of a part: about 60 kB of drawing
constexpr double least_area = 1e-6;             // m^2, in plan

}  // namespace

std::string mesh_silhouette(const PlanView& view, const Scene& scene, const Part& part) {
  if (part.triangle_count == 0 || part.triangle_count > most_triangles) return {};
  std::string data;
  for (std::uint32_t t = part.first_triangle; t < part.first_triangle + part.triangle_count; ++t) {
    auto [a, b, c] = scene.mesh.triangles[t];
    const Vec3 normal = cross(scene.mesh.vertices[b] - scene.mesh.vertices[a],
                              scene.mesh.vertices[c] - scene.mesh.vertices[a]);
    if (std::abs(normal.z) < 2 * least_area) continue;
    if (normal.z < 0) std::swap(b, c);
    char step = 'M';
    for (const std::uint32_t corner : {a, b, c}) {
      const Point p = view.at(scene.mesh.vertices[corner].x, scene.mesh.vertices[corner].y);
      data += fmt::format("{}{} {}", step, coordinate(p.x), coordinate(p.y));
      step = 'L';
    }
    data += 'Z';
  }
  return data;
}

std::string mesh_silhouette(const PlanView& view, const Scene& scene, std::uint32_t fixture) {
  std::string data;
  for (const Part& part : scene.parts) {
    if (part.fixture != fixture || part.kind == PartKind::shell || part.footprint.size() < 3) continue;
    const std::string of_part = mesh_silhouette(view, scene, part);
    if (of_part.empty()) return {};
    data += of_part;
  }
  return data;
}

}  // namespace shelfbeam
