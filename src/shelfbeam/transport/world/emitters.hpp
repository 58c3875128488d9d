#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/math/frame.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// A point of a light source.
struct LightPoint {
  Vec3 position;
  Vec3 normal;      ///< unit length, of the disc or surface
  double area = 0;  ///< of the whole source, m^2; 0 for a point source
};

/// Light that leaves a source.
struct Emitted {
  LightPoint from;
  Vec3 direction;
  double flux = 0;  ///< of the whole source, W
};

/// The light sources of a scene, one column of the signal matrix each: transceivers (points and discs), then
/// emitting surfaces.
class Emitters {
 public:
  /// Throws std::invalid_argument for an emitting surface without area.
  explicit Emitters(const Scene& scene);

  std::size_t size() const { return units_.size() + surfaces_.size(); }
  const std::string& id(std::size_t j) const {
    return j < units_.size() ? *units_[j].id : *surfaces_[j - units_.size()].id;
  }
  bool is_transceiver(std::size_t j) const { return j < units_.size(); }
  bool is_point(std::size_t j) const { return j < units_.size() && units_[j].area == 0; }

  /// Samples a point of the source uniformly over its area, from two uniform random numbers.
  LightPoint point(std::size_t j, double u1, double u2) const;

  /// Radiant intensity in W/sr of the whole source, concentrated at `from`, towards a unit-length direction:
  /// I for transceivers, L A |cos| for surfaces.
  double intensity(std::size_t j, const LightPoint& from, const Vec3& direction) const;

  /// Samples a point and a direction in proportion to the emitted radiance, from uniform random numbers; no
  /// value if the sample has density 0.
  std::optional<Emitted> emit(std::size_t j, const std::array<double, 4>& u) const;

  /// Calls use(j, light point, radiance towards the ray's origin) for every disc that a ray crosses between
  /// the distances `nearest` and `farthest`.
  template <class Use>
  void each_disc(const RayScene& rays, const Vec3& origin, const Vec3& direction, double nearest,
                 double farthest, Use use) const {
    for (const DiscPlane& plane : disc_planes_) {
      const double along = dot(direction, plane.normal);
      const double distance = (plane.offset - dot(origin, plane.normal)) / along;
      if (!rays.is_between(distance, nearest, farthest)) continue;
      const Vec3 position = origin + direction * distance;
      for (const std::uint32_t j : plane.discs) {
        const Unit& unit = units_[j];
        if (!(length_squared(position - unit.position) <= unit.radius * unit.radius)) continue;
        const LightPoint point{position, plane.normal, unit.area};
        const double radiance = intensity(j, point, -direction) / (unit.area * std::abs(along));
        if (radiance > 0) use(j, point, radiance);
      }
    }
  }

  /// Column of the emitting surface with this material.
  std::optional<std::size_t> surface_of(MaterialId material) const;
  /// Radiance of an emitting surface in W/(m^2 sr) and the area of one of its sides in m^2.
  double radiance(std::size_t j) const { return surfaces_[j - units_.size()].radiance; }
  double area(std::size_t j) const { return surfaces_[j - units_.size()].areas.back(); }

 private:
  struct Unit {
    Vec3 position;
    Frame frame;
    double radius, area;
    const Emission* emission;
    double relative_power;
    const std::string* id;
  };
  struct DiscPlane {  ///< all discs of a grid lie in one plane, which a ray intersects once
    Vec3 normal;
    double offset;  ///< dot(normal, p) for its points p
    std::vector<std::uint32_t> discs;
  };
  struct Triangle {
    Vec3 corner, edge1, edge2;
  };
  struct Surface {
    const std::string* id;
    MaterialId material;
    double radiance;
    std::vector<Triangle> triangles;
    std::vector<double> areas;  ///< cumulative, by triangle
  };
  std::vector<Unit> units_;
  std::vector<DiscPlane> disc_planes_;
  std::vector<Surface> surfaces_;
};

/// Density per solid angle, seen from `seen_from`, with which Emitters::point samples this point; infinite
/// for point sources, which only a connection can reach.
double light_pdf(const LightPoint& point, const Vec3& seen_from);

}  // namespace shelfbeam
