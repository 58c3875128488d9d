#include "shelfbeam/transport/world/contacts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>
#include <variant>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

constexpr double same_direction = 0.98;
constexpr double same_place = 1e-9;  // m, far above rounding errors of positions
constexpr auto none = std::numeric_limits<std::uint32_t>::max();

// Share of the sphere that a triangle covers, seen from `p`, by the sign of its winding (Van Oosterom and
// Strackee, IEEE Trans. Biomed. Eng. 1983); 0 from its plane.
double covered(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  const double volume = dot(a, cross(b, c));
  if (std::abs(volume) <= 1e-9 * la * lb * lc) return 0;
  return std::atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb) / (2 * pi);
}

// Tells on which side of the opaque surfaces of a fixture their solid lies, by the winding number (Jacobson,
// Kavan, Sorkine-Hornung, ACM Trans. Graph. 2013). In the air it is that of a label. On the surface of a
// closed solid it differs from this by a half, on a flat sheet it does not.
class Windings {
 public:
  explicit Windings(const Scene& scene) : scene_(scene), fixture_of_(scene.mesh.triangles.size(), none) {
    for (std::uint32_t f = 0; f < scene.fixtures.size(); ++f)
      for (std::uint32_t k = 0; k < scene.fixtures[f].triangle_count; ++k)
        fixture_of_[scene.fixtures[f].first_triangle + k] = f;
    for (std::uint32_t t = 0; t < fixture_of_.size(); ++t)
      if (is_opaque(scene.materials[scene.mesh.materials[t].value].material))
        opaque_[fixture_of_[t]].push_back(t);
  }

  /// 1 if a solid lies behind the normal of a triangle with this middle, -1 if before it, 0 if there is none,
  /// or if the triangles of all questions are too many.
  double side(std::uint32_t triangle, const Vec3& middle) {
    const std::uint32_t fixture = fixture_of_[triangle];
    const std::size_t effort = opaque_.at(fixture).size();
    if (effort > left_) return 0;
    left_ -= effort;
    auto air = air_.find(fixture);
    if (air == air_.end()) {
      constexpr double in_front = 1e-3;  // m
      const Label* const label = scene_.labels.empty() ? nullptr : &scene_.labels.front();
      const double in_air =
          label != nullptr ? number(fixture, label->position + label->normal * in_front) : 0;
      air = air_.emplace(fixture, std::round(in_air)).first;
    }
    const double here = number(fixture, middle) - air->second;
    constexpr double clear = 0.2;
    if (std::abs(std::abs(here) - 0.5) > clear) return 0;
    return here > 0 ? 1 : -1;
  }

 private:
  double number(std::uint32_t fixture, const Vec3& p) const {
    const TriangleMesh& mesh = scene_.mesh;
    double sum = 0;
    for (const std::uint32_t t : opaque_.at(fixture)) {
      const auto& [a, b, c] = mesh.triangles[t];
      sum += covered({mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]}, p);
    }
    return sum;
  }

  const Scene& scene_;
  std::vector<std::uint32_t> fixture_of_;                       // none: the room
  std::map<std::uint32_t, std::vector<std::uint32_t>> opaque_;  // triangles by fixture
  std::map<std::uint32_t, double> air_;                         // winding number in the air, by fixture
  std::size_t left_ = 50'000'000;                               // triangles, of which 10 million take 0.1 s
};

}  // namespace

Bounds Contacts::Face::bounds() const {
  Bounds box;
  box.include(corner);
  box.include(corner + edge1);
  box.include(corner + edge2);
  return box;
}

Contacts::Face Contacts::make_face(const TriangleMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangles[triangle];
  const Vec3 corner = mesh.vertices[a], edge1 = mesh.vertices[b] - corner, edge2 = mesh.vertices[c] - corner;
  return {triangle, corner, edge1, edge2, mesh.materials[triangle], normalized(cross(edge1, edge2))};
}

Contacts::Contacts(const Scene& scene, const Limits& limits) : limits_(limits) {
  const TriangleMesh& mesh = scene.mesh;
  std::vector<Face> glass;
  std::vector<Bounds> boxes;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (is_opaque(scene.materials[mesh.materials[t].value].material)) continue;
    glass.push_back(make_face(mesh, t));
    boxes.push_back(glass.back().bounds().wider_by(limits.reach));
  }
  if (glass.empty()) return;

  const BoxIndex near_glass(std::move(boxes));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const Face other = make_face(mesh, t);
    near_glass.any(other.bounds(), [&](std::uint32_t k) {
      if (glass[k].triangle != t && touch(glass[k], other)) {
        pairs.emplace_back(t, glass[k].triangle);
        pairs.emplace_back(glass[k].triangle, t);
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
    faces_.push_back(make_face(mesh, t));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) first_[t + 1] += first_[t];
  find_solids(scene);
  boxes.clear();
  for (const Face& face : faces_) boxes.push_back(face.bounds());
  index_ = BoxIndex(std::move(boxes));
}

// Whether two nearly parallel triangles overlap in the plane of the first, within reach of it.
bool Contacts::touch(const Face& a, const Face& b) const {
  if (!(std::abs(dot(a.normal, b.normal)) >= same_direction)) return false;
  const std::array<Vec3, 3> first{a.corner, a.corner + a.edge1, a.corner + a.edge2};
  const std::array<Vec3, 3> second{b.corner, b.corner + b.edge1, b.corner + b.edge2};
  const auto extent = [](const std::array<Vec3, 3>& points, const Vec3& origin, const Vec3& axis) {
    std::array<double, 3> along{};
    for (std::size_t k = 0; k < 3; ++k) along[k] = dot(points[k] - origin, axis);
    const auto [low, high] = std::minmax_element(along.begin(), along.end());
    return std::pair{*low, *high};
  };
  const auto [low, high] = extent(second, a.corner, a.normal);
  if (low > limits_.reach || high < -limits_.reach) return false;
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

// Solid glass lies behind its normals. An opaque surface that touches solid glass has its own solid, if any,
// on the other side.
void Contacts::find_solids(const Scene& scene) {
  const auto material_of = [&](const Face& face) -> const Material& {
    return scene.materials[face.material.value].material;
  };
  std::optional<Windings> windings;
  for (Face& own : faces_) {
    if (is_solid(material_of(own))) own.solid = 1;
    if (!is_opaque(material_of(own))) continue;
    bool is_before = false, is_behind = false;
    for (const std::uint32_t partner : partners(own.triangle)) {
      const Face& other = face(partner);
      if (!is_solid(material_of(other))) continue;
      (dot(own.normal, other.normal) < 0 ? is_before : is_behind) = true;
    }
    if (is_before != is_behind) {
      own.solid = is_before ? 1 : -1;
    } else if (!is_before) {
      if (!windings) windings.emplace(scene);
      own.solid = windings->side(own.triangle, own.corner + (own.edge1 + own.edge2) / 3.0);
    }
  }
}

bool Contacts::has_partner_at(std::uint32_t triangle, const Vec3& at) const {
  return index_.any(Bounds{at, at}.wider_by(2 * limits_.reach),
                    [&](std::uint32_t f) { return are_partners(triangle, faces_[f].triangle); });
}

bool Contacts::are_partners(std::uint32_t a, std::uint32_t b) const {
  if (!has_contact(a)) return false;
  const auto of_a = partners(a);
  return std::binary_search(of_a.begin(), of_a.end(), b);
}

std::vector<Contacts::Crossing> Contacts::stack(std::uint32_t triangle, const Vec3& at,
                                                const Vec3& direction) const {
  std::vector<Crossing> found;
  // Light leaves a solid before and enters it after everything else within its allowance.
  const auto add = [&](const Face& face, double distance) {
    const double along = dot(face.normal, direction), side = face.solid * along;
    const double allowance = side > 0 ? -limits_.overlap / 2 : side < 0 ? limits_.overlap / 2 : 0;
    const double rank = distance + (allowance == 0 ? 0 : allowance / std::abs(along));
    found.push_back({face.triangle, distance, std::round(rank / same_place)});
  };
  add(face(triangle), 0);
  constexpr double least_rise = 1e-3;
  const double rise = std::max(least_rise, std::abs(dot(normal(triangle), direction)));
  const double farthest = limits_.reach / rise;
  Bounds line;
  line.include(at - direction * farthest);
  line.include(at + direction * farthest);
  index_.any(line.wider_by(same_place), [&](std::uint32_t f) {
    const Face& face = faces_[f];
    if (face.triangle == triangle) return false;
    const double distance = dot(face.corner - at, face.normal) / dot(face.normal, direction);
    if (!(std::abs(distance) <= farthest)) return false;
    const Vec3 p = at + direction * distance - face.corner;
    const Vec3 whole = cross(face.edge1, face.edge2);
    const double u = dot(cross(p, face.edge2), whole), v = dot(cross(face.edge1, p), whole);
    if (u >= 0 && v >= 0 && u + v <= length_squared(whole)) add(face, distance);
    return false;
  });
  const auto lowest = std::min_element(found.begin(), found.end(),
                                       [](const auto& a, const auto& b) { return a.triangle < b.triangle; });
  // Any direction that no wall is parallel to decides which side of coincident surfaces comes first.
  const Vec3 &n = normal(lowest->triangle), aside{0.61, 0.53, 0.59};
  const bool is_reversed = dot(n, aside) * dot(n, direction) < 0;
  std::sort(found.begin(), found.end(), [&](const Crossing& a, const Crossing& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    return is_reversed ? a.triangle > b.triangle : a.triangle < b.triangle;
  });
  return found;
}

}  // namespace shelfbeam
