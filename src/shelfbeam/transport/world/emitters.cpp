#include "shelfbeam/transport/world/emitters.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <stdexcept>

#include "shelfbeam/math/warp.hpp"

namespace shelfbeam {

namespace {

// Shirley and Chiu's map of the square to the disc of radius 1, which keeps strata compact.
std::array<double, 2> disc_point(double u1, double u2) {
  const double a = 2 * u1 - 1, b = 2 * u2 - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b, phi = wide ? pi / 4 * (b / a) : pi / 2 - pi / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

}  // namespace

Emitters::Emitters(const Scene& scene) {
  units_.reserve(scene.transceivers.size());
  std::map<std::array<double, 4>, std::size_t> plane_index;
  for (const Transceiver& unit : scene.transceivers) {
    const TransceiverType& type = scene.type_of(unit);
    if (type.radius > 0) {
      const Vec3& n = unit.axis;
      const double offset = dot(n, unit.position);
      const auto [found, is_new] = plane_index.try_emplace({n.x, n.y, n.z, offset}, disc_planes_.size());
      if (is_new) disc_planes_.push_back({n, offset, {}});
      disc_planes_[found->second].discs.push_back(static_cast<std::uint32_t>(units_.size()));
    }
    units_.push_back({unit.position, Frame::of_device(unit.axis, radians(unit.roll_deg)), type.radius,
                      pi * type.radius * type.radius, &type.emission, unit.relative_power, &unit.id});
  }
  for (const EmittingSurface& source : scene.emitting_surfaces) {
    Surface surface{&source.id, source.material, source.radiance, {}, {}};
    double area = 0;
    for (std::size_t t = 0; t < scene.mesh.triangles.size(); ++t) {
      if (scene.mesh.materials[t] != source.material) continue;
      const auto& [a, b, c] = scene.mesh.triangles[t];
      const Vec3 corner = scene.mesh.vertices[a];
      surface.triangles.push_back({corner, scene.mesh.vertices[b] - corner, scene.mesh.vertices[c] - corner});
      area += length(cross(surface.triangles.back().edge1, surface.triangles.back().edge2)) / 2;
      surface.areas.push_back(area);
    }
    if (!(area > 0)) throw std::invalid_argument("emitting surface '" + source.id + "' has no area");
    surfaces_.push_back(std::move(surface));
  }
}

LightPoint Emitters::point(std::size_t j, double u1, double u2) const {
  if (j < units_.size()) {
    const Unit& unit = units_[j];
    if (unit.area == 0) return {unit.position, unit.frame.z, 0};
    const auto [a, b] = disc_point(u1, u2);
    return {unit.position + unit.frame.to_world({a * unit.radius, b * unit.radius, 0}), unit.frame.z,
            unit.area};
  }
  const Surface& surface = surfaces_[j - units_.size()];
  const double wanted = u1 * surface.areas.back();
  const auto found = std::upper_bound(surface.areas.begin(), surface.areas.end() - 1, wanted);
  const auto t = static_cast<std::size_t>(found - surface.areas.begin());
  const double below = t == 0 ? 0 : surface.areas[t - 1];
  const double v = std::clamp((wanted - below) / (surface.areas[t] - below), 0.0, 1.0), root = std::sqrt(v);
  const Triangle& triangle = surface.triangles[t];
  return {triangle.corner + triangle.edge1 * (root * (1 - u2)) + triangle.edge2 * (root * u2),
          normalized(cross(triangle.edge1, triangle.edge2)), surface.areas.back()};
}

double Emitters::intensity(std::size_t j, const LightPoint& from, const Vec3& direction) const {
  if (j < units_.size()) {
    const Unit& unit = units_[j];
    return unit.relative_power * shelfbeam::intensity(*unit.emission, unit.frame.to_local(direction));
  }
  return radiance(j) * from.area * std::abs(dot(from.normal, direction));
}

std::optional<Emitted> Emitters::emit(std::size_t j, const std::array<double, 4>& u) const {
  const LightPoint from = point(j, u[2], u[3]);
  if (j < units_.size()) {
    const Unit& unit = units_[j];
    const auto drawn = sample(*unit.emission, u[0], u[1]);
    if (!drawn) return std::nullopt;
    return Emitted{from, unit.frame.to_world(drawn->direction), unit.relative_power * power(*unit.emission)};
  }
  // Each side gets half of the random numbers.
  const bool above = u[0] < 0.5;
  const Vec3 local = sample_cosine_hemisphere(2 * u[0] - (above ? 0 : 1), u[1]);
  if (local.z <= 0) return std::nullopt;
  const Vec3 direction = Frame::about(above ? from.normal : -from.normal).to_world(local);
  return Emitted{from, direction, 2 * pi * from.area * radiance(j)};
}

std::optional<std::size_t> Emitters::surface_of(MaterialId material) const {
  for (std::size_t s = 0; s < surfaces_.size(); ++s)
    if (surfaces_[s].material == material) return units_.size() + s;
  return std::nullopt;
}

double light_pdf(const LightPoint& point, const Vec3& seen_from) {
  const Vec3 d = point.position - seen_from;
  const double squared = length_squared(d);
  const double across = std::abs(dot(d, point.normal)) * point.area;  // A d cos
  return across > 0 ? squared * std::sqrt(squared) / across : std::numeric_limits<double>::infinity();
}

}  // namespace shelfbeam
