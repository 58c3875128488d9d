#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shelfbeam/transport/operator/operator_kernels.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Points of surfaces, each with the normal of one side, in single precision.
struct BeamPoints {
  std::vector<float> x, y, z, nx, ny, nz;
  std::vector<std::uint32_t> triangles;

  std::size_t size() const { return x.size(); }
  void add(const SurfacePoint& point);
  SurfacePoint at(std::size_t k) const;
  void reserve(std::size_t count);
  /// Calls use(vector) for everything that a file needs.
  template <class Points, class Use>
  static void each_part(Points& points, const Use& use) {
    for (auto* const values : {&points.x, &points.y, &points.z, &points.nx, &points.ny, &points.nz})
      use(*values);
    use(points.triangles);
  }
  std::size_t bytes() const { return size() * (6 * sizeof(float) + sizeof(std::uint32_t)); }
};

/// The light of one unit on many points, without obstacles. A disc counts as a point at its centre.
class UnitBeam {
 public:
  /// The unit is the only one of `probe`, which must outlive the beam.
  explicit UnitBeam(const World& probe);

  const Vec3& position() const { return light_.position; }
  /// Where rays from the unit start.
  SurfacePoint source() const { return {light_.position, light_.normal}; }
  /// Writes the irradiance at the points from `first` on, W/m^2.
  void irradiance(const BeamPoints& points, std::size_t first, std::size_t count, float* result) const;
  double irradiance(const SurfacePoint& point) const;
  /// The same from the image of the unit in a plane mirror that reflects everything; infinite for emissions
  /// without vectorised code.
  void irradiance_of_image(std::size_t mirror, const BeamPoints& points, float* result) const;
  /// The irradiance of a connection (over a mirror, say) that reaches a surface with this cosine.
  double irradiance(const Connection& way, double cosine) const;

 private:
  const World& probe_;
  LightPoint light_;
  std::optional<OperatorKernels::Unit> fast_;
};

}  // namespace shelfbeam
