#include "shelfbeam/transport/world/coverage.hpp"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <optional>

#include "shelfbeam/transport/world/plane_mirrors.hpp"
#include "shelfbeam/transport/world/rough_coats.hpp"

namespace shelfbeam {

namespace {

bool refracts_smoothly(const Material& material) {
  return is_solid(material) && has_only_specular(material);
}

bool has_units(const Scene& scene, bool points) {
  return std::any_of(scene.transceivers.begin(), scene.transceivers.end(),
                     [&](const Transceiver& unit) { return (scene.type_of(unit).radius == 0) == points; });
}

bool has_labels(const Scene& scene, bool points) {
  return std::any_of(scene.labels.begin(), scene.labels.end(),
                     [&](const Label& label) { return (scene.type_of(label).size[0] == 0) == points; });
}

using Wanted = std::function<bool(const Material&)>;

std::vector<MaterialId> used_materials(const Scene& scene, const Wanted& wanted) {
  const std::vector<bool> used = scene.used_materials();
  std::vector<MaterialId> found;
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
    if (used[m] && wanted(scene.materials[m].material)) found.push_back(MaterialId{m});
  return found;
}

// Paths over mirrors and through glass that no connection finds.
std::vector<LightKind> unconnected_light(const Scene& scene, PathEnd end) {
  std::vector<LightKind> result;
  const std::optional<Scene> rough = with_rough_coats(scene);
  const PlaneMirrors mirrors(rough ? *rough : scene);
  if (mirrors.size() > 1)
    result.push_back({end, PathWay::successive_mirrors, used_materials(scene, is_partly_specular)});
  if (const auto solids = used_materials(scene, refracts_smoothly); !solids.empty())
    result.push_back({end, PathWay::solid_glass, solids});
  for (std::uint32_t m = 0; m < scene.materials.size(); ++m)
    if (mirrors.omitted()[m] > 0)
      result.push_back({end, PathWay::small_mirrors, {MaterialId{m}}, mirrors.omitted()[m]});
  return result;
}

}  // namespace

std::vector<LightKind> uncovered_light(const Scene& scene, Strategy strategy) {
  if (strategy == Strategy::particle)
    return has_labels(scene, true) ? unconnected_light(scene, PathEnd::point_labels)
                                   : std::vector<LightKind>{};
  if (!has_units(scene, true)) return {};
  if (strategy == Strategy::walk) return {{PathEnd::point_transceivers, PathWay::any}};
  return unconnected_light(scene, PathEnd::point_transceivers);
}

std::vector<LightKind> chance_light(const Scene& scene, Strategy strategy) {
  std::vector<LightKind> found;
  const auto add_without_images = [&](bool exists, PathEnd end) {
    const auto bending = used_materials(scene, [](const Material& material) {
      return is_partly_specular(material) || refracts_smoothly(material);
    });
    if (exists && !bending.empty()) found.push_back({end, PathWay::mirrors_and_glass, bending});
  };
  if (strategy == Strategy::particle) {
    add_without_images(has_labels(scene, false), PathEnd::sized_labels);
    return found;
  }
  if (has_units(scene, false)) {
    if (strategy == Strategy::walk)
      found.push_back({PathEnd::disc_transceivers, PathWay::any});
    else
      found = unconnected_light(scene, PathEnd::disc_transceivers);
  }
  if (strategy == Strategy::walk && !scene.emitting_surfaces.empty())
    found.push_back({PathEnd::emitting_surfaces, PathWay::any});
  else
    add_without_images(!scene.emitting_surfaces.empty(), PathEnd::emitting_surfaces);
  return found;
}

}  // namespace shelfbeam
