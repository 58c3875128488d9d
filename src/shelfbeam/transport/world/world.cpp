#include "shelfbeam/transport/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "shelfbeam/transport/world/extent.hpp"

namespace shelfbeam {

namespace {

constexpr double large_enough = 1;  // m
constexpr int exponent_wanted = 2;  // 4 to 8 m

struct TimesIntensity {
  double factor;

  Emission operator()(SinTwoTheta e) const { return SinTwoTheta{factor * e.peak}; }
  Emission operator()(IsotropicHemisphere e) const { return IsotropicHemisphere{factor * e.intensity}; }
  Emission operator()(GeneralizedLambertian e) const {
    return GeneralizedLambertian{e.order, factor * e.flux};
  }
  Emission operator()(const EmissionTable& e) const {
    const double integral = e.intensity.integral();
    return integral > 0 ? EmissionTable{e.intensity.with_integral(factor * integral)} : e;
  }
};

double largest_extent(const Scene& scene) {
  const Bounds box = extent(scene);
  const Vec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

}  // namespace

double enlargement(const Scene& scene) {
  const double extent = largest_extent(scene);
  if (!(extent > 0) || extent >= large_enough) return 1;
  return std::ldexp(1.0, exponent_wanted - std::ilogb(extent));
}

std::optional<Scene> enlarged(const Scene& scene) {
  const double factor = enlargement(scene);
  if (factor == 1) return std::nullopt;
  Scene large = scene;
  large.lower = large.lower * factor;
  large.upper = large.upper * factor;
  if (large.room) large.room = large.room->scaled(factor);
  for (Vec3& vertex : large.mesh.vertices) vertex = vertex * factor;
  for (Label& label : large.labels) label.position = label.position * factor;
  for (LabelType& type : large.label_types)
    for (double& side : type.size) side *= factor;
  for (Transceiver& unit : large.transceivers) unit.position = unit.position * factor;
  for (TransceiverType& type : large.transceiver_types) {
    type.radius *= factor;
    type.emission = std::visit(TimesIntensity{factor * factor}, type.emission);
  }
  large.parts.clear();  // for drawings only
  return large;
}

}  // namespace shelfbeam
