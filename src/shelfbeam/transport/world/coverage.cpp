#include "shelfbeam/transport/world/coverage.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/transport/world/plane_mirrors.hpp"

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

// Names of the materials in use that satisfy `wanted`.
std::string used_materials(const Scene& scene, const Wanted& wanted) {
  const std::vector<bool> used = scene.used_materials();
  std::vector<std::string> found;
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (used[m] && wanted(scene.materials[m].material)) found.push_back(scene.materials[m].name);
  return fmt::format("{}", fmt::join(found, ", "));
}

// Paths over mirrors and through glass that no connection finds, between label and source or to one of them.
std::vector<std::string> unconnected_light(const Scene& scene, const char* way) {
  std::vector<std::string> result;
  const PlaneMirrors mirrors(scene);
  if (mirrors.size() > 1)
    result.push_back(fmt::format("light {} via two or more mirrors in succession ({})", way,
                                 used_materials(scene, is_partly_specular)));
  if (const std::string solids = used_materials(scene, refracts_smoothly); !solids.empty())
    result.push_back(fmt::format("light {} refracted by solid glass ({})", way, solids));
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (mirrors.omitted()[m] > 0)
      result.push_back(fmt::format("light {} via {} small mirrors of '{}'", way, mirrors.omitted()[m],
                                   scene.materials[m].name));
  return result;
}

}  // namespace

std::vector<std::string> uncovered_light(const Scene& scene, Strategy strategy) {
  if (strategy == Strategy::particle)
    return has_labels(scene, true) ? unconnected_light(scene, "to point labels") : std::vector<std::string>{};
  constexpr auto from_points = "from point transceivers";
  if (!has_units(scene, true)) return {};
  if (strategy == Strategy::walk) return {fmt::format("all light {}", from_points)};
  return unconnected_light(scene, from_points);
}

std::vector<std::string> chance_light(const Scene& scene, Strategy strategy) {
  std::vector<std::string> found;
  const auto add_without_images = [&](bool exists, const char* way) {
    const std::string bending = used_materials(scene, [](const Material& material) {
      return is_partly_specular(material) || refracts_smoothly(material);
    });
    if (exists && !bending.empty())
      found.push_back(fmt::format("light {} via mirrors and through solid glass ({})", way, bending));
  };
  if (strategy == Strategy::particle) {
    add_without_images(has_labels(scene, false), "to labels with a size");
    return found;
  }
  constexpr auto from_discs = "from disc transceivers";
  if (has_units(scene, false)) {
    if (strategy == Strategy::walk)
      found.push_back(fmt::format("all light {}", from_discs));
    else
      found = unconnected_light(scene, from_discs);
  }
  if (strategy == Strategy::walk && !scene.emitting_surfaces.empty())
    found.emplace_back("all light from emitting surfaces");
  else
    add_without_images(!scene.emitting_surfaces.empty(), "from emitting surfaces");
  return found;
}

}  // namespace shelfbeam
