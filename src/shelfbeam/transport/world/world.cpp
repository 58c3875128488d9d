#include "shelfbeam/transport/world/world.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "shelfbeam/transport/world/extent.hpp"
#include "shelfbeam/transport/world/glass_devices.hpp"
#include "shelfbeam/transport/world/rough_coats.hpp"

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

std::optional<Devices> off_glass(const Scene& scene, Devices devices, double enlargement) {
  constexpr double margin = 1.25;
  return devices_off_glass(scene, std::move(devices), margin * ray_coordinates(scene).end(),
                           max_overlap / 2 * enlargement);
}

double largest_extent(const Scene& scene) {
  const Bounds box = extent(scene);
  const Vec3 size = box.high - box.low;
  return std::max({size.x, size.y, size.z});
}

Scene times(const Scene& scene, double factor) {
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

}  // namespace

double enlargement(const Scene& scene) {
  const double extent = largest_extent(scene);
  if (!(extent > 0) || extent >= large_enough) return 1;
  return std::ldexp(1.0, exponent_wanted - std::ilogb(extent));
}

std::optional<Scene> ready_for_light(const Scene& scene) {
  std::optional<Scene> own;
  const double factor = enlargement(scene);
  if (factor != 1) own = times(scene, factor);
  if (auto rough = with_rough_coats(own ? *own : scene)) own = std::move(rough);
  const Scene& now = own ? *own : scene;
  if (auto devices = off_glass(now, {now.labels, now.transceivers}, factor)) {
    if (!own) own = scene;
    own->labels = std::move(devices->labels);
    own->transceivers = std::move(devices->transceivers);
  }
  return own;
}

Scene with_other_units(const World& like, std::vector<Transceiver> units, bool with_labels) {
  const double factor = like.surfaces->enlargement;
  for (Transceiver& unit : units) unit.position = unit.position * factor;
  Scene scene;
  scene.wavelength_nm = like.scene.wavelength_nm;
  scene.room = like.scene.room;  // its openings
  scene.materials = like.scene.materials;
  scene.label_types = like.scene.label_types;
  scene.transceiver_types = like.scene.transceiver_types;
  if (with_labels) scene.labels = like.scene.labels;
  scene.transceivers = units;
  if (auto devices = off_glass(like.scene, {{}, std::move(units)}, factor))
    scene.transceivers = std::move(devices->transceivers);
  return scene;
}

}  // namespace shelfbeam
