#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::test {

/// Tolerance of lengths, in metres: coordinates are of the order of 1 m, and rotation and its inverse cost a
/// few 1e-16.
inline constexpr double exact = 1e-9;

/// The triangles of one box or door of a scene.
struct Solid {
  Part part;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// The boxes and doors of a scene that has no other triangles but the twelve of its room, if it has one.
inline std::vector<Solid> solids_of(const Scene& scene) {
  std::vector<Solid> solids;
  std::size_t next = scene.room ? 12 : 0;
  for (const Part& part : scene.parts) {
    Solid solid{part, {}};
    const int count = part.kind == PartKind::door ? 2 : 12;
    for (int t = 0; t < count; ++t) solid.triangles.push_back(scene.mesh.triangles.at(next++));
    solids.push_back(std::move(solid));
  }
  return solids;
}

inline std::vector<Solid> solids_of(const Scene& scene, PartKind kind) {
  auto solids = solids_of(scene);
  std::erase_if(solids, [&](const Solid& solid) { return solid.part.kind != kind; });
  return solids;
}

/// Whether every directed edge has exactly one opposite partner: the surface is closed, and its triangles
/// have one orientation.
inline bool is_closed(const Solid& solid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : solid.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto partner = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && partner != edges.end() && partner->second == 1;
  });
}

/// The volumes by the divergence theorem; positive if the triangles face outwards.
inline double volume(const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    six += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  return six / 6;
}

inline double volume(const Solid& solid, const TriangleMesh& mesh) {
  double six = 0;
  for (const auto& [a, b, c] : solid.triangles)
    six += dot(mesh.vertices[a], cross(mesh.vertices[b], mesh.vertices[c]));
  return six / 6;
}

inline double area(const Solid& solid, const TriangleMesh& mesh) {
  double twice = 0;
  for (const auto& [a, b, c] : solid.triangles)
    twice += length(cross(mesh.vertices[b] - mesh.vertices[a], mesh.vertices[c] - mesh.vertices[a]));
  return twice / 2;
}

/// The edges that belong to an odd number of triangles, of which a closed surface has none; without one
/// material.
inline std::vector<std::array<std::uint32_t, 2>> open_edges(const TriangleMesh& mesh,
                                                            std::optional<MaterialId> without = {}) {
  std::map<std::array<std::uint32_t, 2>, int> count;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3 && mesh.materials[t] != without; ++k) {
      const auto [a, b] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      ++count[{a, b}];
    }
  std::erase_if(count, [](const auto& edge) { return edge.second % 2 == 0; });
  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(count.size());
  for (const auto& [edge, times] : count) edges.push_back(edge);
  return edges;
}

/// The area of the triangles of each material, m^2.
inline std::map<std::string, double> areas_of(const Scene& scene) {
  std::map<std::string, double> areas;
  const auto& p = scene.mesh.vertices;
  for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = scene.mesh.triangles[t];
    areas[scene.materials[scene.mesh.materials[t].value].name] += length(cross(p[b] - p[a], p[c] - p[a])) / 2;
  }
  return areas;
}

/// The area of all triangles, m^2.
inline double mesh_area(const Scene& scene) {
  double sum = 0;
  for (const auto& [material, area] : areas_of(scene)) sum += area;
  return sum;
}

/// Area of a polygon; positive if it is counter-clockwise.
inline double signed_area(const std::vector<std::array<double, 2>>& polygon) {
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const auto& p = polygon[k];
    const auto& q = polygon[(k + 1) % polygon.size()];
    twice += p[0] * q[1] - p[1] * q[0];
  }
  return twice / 2;
}

}  // namespace shelfbeam::test
