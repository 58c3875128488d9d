#include "shelfbeam/transport/world/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

constexpr double same_direction = 0.98;
constexpr double same_place = 1e-9;  // m, far above rounding errors of positions
constexpr auto none = std::numeric_limits<std::uint32_t>::max();

std::array<Vec3, 3> corners(const TriangleMesh& mesh, std::uint32_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]};
}

Bounds bounds(const TriangleMesh& mesh, std::uint32_t t) {
  Bounds box;
  for (const Vec3& p : corners(mesh, t)) box.include(p);
  return box;
}

// Share of the sphere that a triangle covers, seen from `p`, by the sign of its winding (Van Oosterom and
// Strackee, IEEE Trans. Biomed. Eng. 1983); 0 from its plane.
double covered(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = dot(a, cross(b, c));
  if (std::abs(volume) <= 1e-9 * la * lb * lc) return 0;
  return std::atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) / (2 * pi);
}

}  // namespace

Contacts::Contacts(const Scene& scene, double reach) : reach_(reach) {
  const TriangleMesh& mesh = scene.mesh;
  std::vector<std::uint32_t> glass;
  std::vector<Bounds> boxes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_opaque(scene.materials[mesh.materials[t].value].material)) continue;
    glass.push_back(t);
    boxes.push_back(bounds(mesh, t).wider_by(reach));
  }
  if (glass.empty()) return;

  const auto face = [&](std::uint32_t t) {
    const auto [a, b, c] = corners(mesh, t);
    return Face{a, b - a, c - a, mesh.materials[t], normalized(cross(b - a, c - a))};
  };
  const BoxIndex index(std::move(boxes));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    index.any(bounds(mesh, t), [&](std::uint32_t k) {
      if (glass[k] != t && touch(face(glass[k]), face(t))) {
        pairs.emplace_back(t, glass[k]);
        pairs.emplace_back(glass[k], t);
      }
      return false;
    });
  }
  if (pairs.empty()) return;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_.assign(mesh.triangles.size() + 1, 0);
  face_of_.assign(mesh.triangles.size(), none);
  for (const auto& [t, partner] : pairs) {
    ++first_[t + 1];
    partners_.push_back(partner);
    if (face_of_[t] != none) continue;
    face_of_[t] = static_cast<std::uint32_t>(faces_.size());
    faces_.push_back(face(t));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) first_[t + 1] += first_[t];
  find_solids(scene);
}

// Whether two nearly parallel triangles overlap in the plane of the first, within reach of it.
bool Contacts::touch(const Face& a, const Face& b) const {
  if (std::abs(dot(a.normal, b.normal)) < same_direction) return false;
  const std::array<Vec3, 3> first{a.corner, a.corner + a.edge1, a.corner + a.edge2};
  const std::array<Vec3, 3> second{b.corner, b.corner + b.edge1, b.corner + b.edge2};
  const auto extent = [](const std::array<Vec3, 3>& points, const Vec3& origin, const Vec3& axis) {
    std::array<double, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) along[k] = dot(points[k] - origin, axis);
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    return std::pair{*low, *high};
  };
  const auto [low, high] = extent(second, a.corner, a.normal);
  if (low > reach_ || high < -reach_) return false;
  // Triangles that only share an edge do not overlap.
  for (const auto& triangle : {first, second})
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 edge = triangle[(k + 1) % 3] - triangle[k];
      const Vec3 axis = normalized(cross(a.normal, edge));
      const auto [low1, high1] = extent(first, a.corner, axis);
      const auto [low2, high2] = extent(second, a.corner, axis);
      const double common = std::min(high1, high2) - std::max(low1, low2);
      if (common <= 1e-9 * std::max(high1 - low1, high2 - low2)) return false;
    }
  return true;
}

// Solid glass lies behind its normals. On which side of an opaque triangle its solid lies follows from the
// winding number (Jacobson, Kavan, Sorkine-Hornung, ACM Trans. Graph. 2013) of its fixture, which is that of
// a label in the air and changes by 1 inside the solid; at a sheet it changes by 1/2 only.
void Contacts::find_solids(const Scene& scene) {
  const TriangleMesh& mesh = scene.mesh;
  std::vector<std::uint32_t> fixture_of(mesh.triangles.size(), none);
  for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f)
    for (std::uint32_t k = 0; k < scene.fixtures[f].triangle_count; ++k)
      fixture_of[scene.fixtures[f].first_triangle + k] = f;
  const auto opaque = [&](std::uint32_t t) {
    return is_opaque(scene.materials[mesh.materials[t].value].material);
  };
  const auto winding = [&](std::uint32_t fixture, const Vec3& p) {
    double sum = 0;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
      if (fixture_of[t] == fixture && opaque(t)) sum += covered(corners(mesh, t), p);
    return sum;
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (face_of_[t] == none) continue;
    Face& face = faces_[face_of_[t]];
    const Material& material = scene.materials[mesh.materials[t].value].material;
    if (std::holds_alternative<Dielectric>(material)) face.solid = 1;
    if (!opaque(t) || scene.labels.empty()) continue;
    const double air = winding(fixture_of[t], scene.labels.front().position);
    const double here = winding(fixture_of[t], face.corner + (face.edge1 + face.edge2) / 3.0) - air;
    constexpr double clear = 0.2;
    if (std::abs(std::abs(here) - 0.5) < clear) face.solid = here > 0 ? 1 : -1;
  }
}

bool Contacts::are_partners(std::uint32_t a, std::uint32_t b) const {
  if (!contain(a)) return false;
  const auto begin = partners_.begin();
  return std::binary_search(begin + first_[a], begin + first_[a + 1], b);
}

std::vector<Contacts::Crossing> Contacts::stack(std::uint32_t triangle, const Vec3& at,
                                                const Vec3& direction) const {
  std::vector<Crossing> found;
  const double rise = std::abs(dot(faces_[face_of_[triangle]].normal, direction));
  // Light leaves a solid before and enters it after everything else within its allowance.
  const auto add = [&](std::uint32_t t, double distance) {
    const Face& face = faces_[face_of_[t]];
    const double side = face.solid * dot(face.normal, direction);
    const double allowance = side > 0 ? -max_overlap / 2 : side < 0 ? max_overlap / 2 : 0;
    found.push_back({t, distance, std::round((distance * rise + allowance) / same_place)});
  };
  add(triangle, 0);
  for (std::uint32_t k = first_[triangle]; k < first_[triangle + 1]; ++k) {
    const Face& face = faces_[face_of_[partners_[k]]];
    const double along = dot(face.normal, direction);
    const double distance = dot(face.corner - at, face.normal) / along;
    if (!(std::abs(distance) * rise <= reach_)) continue;
    const Vec3 p = at + direction * distance - face.corner;
    const Vec3 whole = cross(face.edge1, face.edge2);
    const double area = length_squared(whole);
    const double u = dot(cross(p, face.edge2), whole), v = dot(cross(face.edge1, p), whole);
    if (u >= 0 && v >= 0 && u + v <= area) add(partners_[k], distance);
  }
  const auto lowest = std::min_element(found.begin(), found.end(),
                                       [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  const Vec3& n = faces_[face_of_[lowest->triangle]].normal;
  const double lead = std::abs(n.x) > 0.5 ? n.x : std::abs(n.y) > 0.5 ? n.y : n.z;
  const bool is_reversed = lead * dot(n, direction) < 0;
  std::sort(found.begin(), found.end(), [&](const Crossing& a, const Crossing& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    return is_reversed ? a.triangle > b.triangle : a.triangle < b.triangle;
  });
  return found;
}

}  // namespace shelfbeam
