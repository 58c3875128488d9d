#include "shelfbeam/transport/world/plane_mirrors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

namespace {

// Tolerance of coplanarity, in the normal and, relative to the size of the scene, in the offset.
constexpr double same_plane = 1e-6;

// Opposite normals belong to the same plane.
Vec3 canonical(const Vec3& n) {
  const double lead = std::abs(n.x) > 0.5 ? n.x : std::abs(n.y) > 0.5 ? n.y : n.z;
  return lead < 0 ? -n : n;
}

}  // namespace

bool is_partly_specular(const Material& material) {
  return specular_reflectance(material, {0, 0, 1}) > 0;
}

PlaneMirrors::PlaneMirrors(const Scene& scene) : scene_(scene), left_out_(scene.materials.size()) {
  std::vector<bool> is_mirror;
  for (const NamedMaterial& named : scene.materials) is_mirror.push_back(is_partly_specular(named.material));
  const TriangleMesh& mesh = scene.mesh;
  const double size = std::max(1.0, length(scene.upper - scene.lower));
  constexpr double infinite = std::numeric_limits<double>::infinity();

  // Groups triangles by rounded plane. A plane on the edge between two roundings may give two groups; this
  // only costs time.
  std::map<std::array<std::int64_t, 4>, std::uint32_t> index;
  std::vector<Mirror> groups;
  std::vector<std::uint32_t> group_of(mesh.triangles.size(), std::numeric_limits<std::uint32_t>::max());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!is_mirror[mesh.materials[t].value]) continue;
    std::array<Vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.vertices[mesh.triangles[t][k]];
    const Vec3 across = cross(p[1] - p[0], p[2] - p[0]);
    const Vec3 n = canonical(normalized(across));
    const double offset = dot(n, p[0]);
    const auto rounded = [](double value) { return std::llround(value / (10 * same_plane)); };
    const auto [found, is_new] =
        index.try_emplace({rounded(n.x), rounded(n.y), rounded(n.z), rounded(offset / size)},
                          static_cast<std::uint32_t>(groups.size()));
    if (is_new)
      groups.push_back({n, offset, {infinite, infinite, infinite}, {-infinite, -infinite, -infinite}, 0});
    Mirror& group = groups[found->second];
    for (const Vec3& q : p) {
      group.low = {std::min(group.low.x, q.x), std::min(group.low.y, q.y), std::min(group.low.z, q.z)};
      group.high = {std::max(group.high.x, q.x), std::max(group.high.y, q.y), std::max(group.high.z, q.z)};
    }
    group.area += length(across) / 2;
    group_of[t] = found->second;
  }

  std::vector<std::uint32_t> kept(groups.size(), std::numeric_limits<std::uint32_t>::max());
  for (const std::uint32_t g : ordered_by(groups.size(), [&](std::uint32_t g) { return -groups[g].area; })) {
    if (mirrors_.size() == max_mirrors || groups[g].area < min_area) break;
    kept[g] = static_cast<std::uint32_t>(mirrors_.size());
    Mirror mirror = groups[g];
    const Vec3 slack{10 * same_plane * size, 10 * same_plane * size, 10 * same_plane * size};
    mirror.low = mirror.low - slack;
    mirror.high = mirror.high + slack;
    mirrors_.push_back(mirror);
  }
  const auto no_mirror = static_cast<std::uint32_t>(mirrors_.size());
  mirror_of_.assign(mesh.triangles.size(), no_mirror);
  for (std::size_t t = 0; t < group_of.size(); ++t) {
    if (group_of[t] >= kept.size()) continue;
    mirror_of_[t] = std::min(no_mirror, kept[group_of[t]]);
    if (mirror_of_[t] == no_mirror) ++left_out_[mesh.materials[t].value];
  }
}

std::optional<Connection> PlaneMirrors::mirror_path(std::size_t g, const Vec3& first,
                                                    const Vec3& second) const {
  const Mirror& mirror = mirrors_[g];
  const double a = dot(mirror.normal, first) - mirror.offset, b = dot(mirror.normal, second) - mirror.offset;
  if (!(a * b > 0)) return std::nullopt;
  const Vec3 image = second - mirror.normal * (2 * b);
  const Vec3 whole = image - first;
  const Vec3 at = first + whole * (a / (a + b));
  for (int axis = 0; axis < 3; ++axis)
    if (at[axis] < mirror.low[axis] || at[axis] > mirror.high[axis]) return std::nullopt;
  const double squared = length_squared(whole);
  if (!(squared > 0)) return std::nullopt;
  // The law of reflection stays precise where `second` almost touches the mirror.
  const Vec3 from_first = whole / std::sqrt(squared);
  return Connection{from_first, mirror.normal * (2 * dot(mirror.normal, from_first)) - from_first, squared};
}

double PlaneMirrors::share(std::size_t g, const Connection& way, const SurfacePoint& first,
                           const Vec3& second, const RayScene& rays) const {
  double share = 1, sum = 0;
  SurfacePoint from = first;
  for (;;) {
    const auto hit = rays.intersect(from, way.from_first);
    if (!hit) return sum;
    const Material& material = scene_.materials[hit->material.value].material;
    const double cosine = -dot(hit->point.normal, way.from_first);
    if (mirror_of_[hit->point.triangle] == g) {
      const double reflected =
          share * specular_reflectance(material, {std::sqrt(std::max(0.0, 1 - cosine * cosine)), 0, cosine});
      if (reflected > 0) sum += reflected * rays.transmittance(hit->point, second).share;
      // Behind a pane there may be another mirror of the group.
      if (!rays.has_contact(hit->point)) return sum;
    } else if (sum > 0) {
      return sum;
    }
    if (!is_pane(material)) return sum;
    share *= pane_transmittance(material, cosine);
    if (share == 0) return sum;
    from = hit->point;
  }
}

}  // namespace shelfbeam
