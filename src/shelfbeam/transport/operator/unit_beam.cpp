#include "shelfbeam/transport/operator/unit_beam.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

namespace shelfbeam {

namespace {

LaneVector narrow(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

// Nothing for profiles without vectorised code.
std::optional<OperatorKernels::Unit> fast_unit(const Transceiver& unit, const Emission& emission) {
  const auto with = [&](LaneProfile profile, double scale) {
    return OperatorKernels::Unit{profile, narrow(unit.position), narrow(unit.axis),
                                 static_cast<float>(scale * unit.relative_power)};
  };
  if (const auto* sine = std::get_if<SinTwoTheta>(&emission)) return with(LaneProfile::sine, sine->peak);
  if (const auto* isotropic = std::get_if<IsotropicHemisphere>(&emission))
    return with(LaneProfile::isotropic, isotropic->intensity);
  const auto* lambertian = std::get_if<GeneralizedLambertian>(&emission);
  if (lambertian != nullptr && lambertian->order == 1)
    return with(LaneProfile::lambertian, mean_intensity(emission, 0));
  return std::nullopt;
}

OperatorKernels::Points from(const BeamPoints& points, std::size_t first) {
  return {points.x.data() + first,  points.y.data() + first,  points.z.data() + first,
          points.nx.data() + first, points.ny.data() + first, points.nz.data() + first};
}

}  // namespace

void BeamPoints::add(const SurfacePoint& point) {
  const LaneVector at = narrow(point.position), normal = narrow(point.normal);
  x.push_back(at.x);
  y.push_back(at.y);
  z.push_back(at.z);
  nx.push_back(normal.x);
  ny.push_back(normal.y);
  nz.push_back(normal.z);
  triangles.push_back(point.triangle);
}

SurfacePoint BeamPoints::at(std::size_t k) const {
  const auto wide = [](float v) { return static_cast<double>(v); };
  return {{wide(x[k]), wide(y[k]), wide(z[k])}, {wide(nx[k]), wide(ny[k]), wide(nz[k])}, triangles[k]};
}

void BeamPoints::reserve(std::size_t count) {
  for (std::vector<float>* const values : {&x, &y, &z, &nx, &ny, &nz}) values->reserve(count);
  triangles.reserve(count);
}

UnitBeam::UnitBeam(const World& probe)
    : probe_(probe),
      light_(probe.emitters.point(0, 0.5, 0.5)),
      fast_(fast_unit(probe.scene.transceivers[0],
                      probe.scene.type_of(probe.scene.transceivers[0]).emission)) {}

void UnitBeam::irradiance(const BeamPoints& points, std::size_t first, std::size_t count,
                          float* result) const {
  if (fast_) {
    OperatorKernels::irradiance(*fast_, from(points, first), count, result);
    return;
  }
  for (std::size_t k = 0; k < count; ++k) result[k] = static_cast<float>(irradiance(points.at(first + k)));
}

void UnitBeam::irradiance_of_image(std::size_t mirror, const BeamPoints& points, float* result) const {
  if (!fast_) {
    std::fill_n(result, points.size(), std::numeric_limits<float>::infinity());
    return;
  }
  const Transceiver& unit = probe_.scene.transceivers[0];
  OperatorKernels::Unit image = *fast_;
  image.position = narrow(probe_.mirrors.image(mirror, unit.position));
  image.axis = narrow(probe_.mirrors.image_direction(mirror, unit.axis));
  OperatorKernels::irradiance(image, from(points, 0), points.size(), result);
}

double UnitBeam::irradiance(const SurfacePoint& point) const {
  const Vec3 way = light_.position - point.position;
  const double facing = dot(way, point.normal);
  if (!(facing > 0)) return 0;
  const double squared = std::max(length_squared(way), static_cast<double>(min_squared_distance)),
               distance = std::sqrt(squared);
  return probe_.emitters.intensity(0, light_, way / -distance) * facing / (squared * distance);
}

double UnitBeam::irradiance(const Connection& way, double cosine) const {
  return probe_.emitters.intensity(0, light_, way.from_second) * cosine / way.length_squared;
}

}  // namespace shelfbeam
