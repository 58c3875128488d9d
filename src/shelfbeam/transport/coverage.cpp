#include "shelfbeam/transport/coverage.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "shelfbeam/transport/plane_mirrors.hpp"

namespace shelfbeam {

namespace {

bool refracts_smoothly(const Material& material) {
  const auto* solid = std::get_if<Dielectric>(&material);
  return solid != nullptr && solid->has_only_specular();
}

bool has_points(const Scene& scene, Strategy strategy) {
  if (strategy == Strategy::particle)
    return std::any_of(scene.labels.begin(), scene.labels.end(),
                       [&](const Label& label) { return scene.type_of(label).size[0] == 0; });
  return std::any_of(scene.transceivers.begin(), scene.transceivers.end(),
                     [&](const Transceiver& unit) { return scene.type_of(unit).radius == 0; });
}

}  // namespace

std::vector<std::string> uncovered_light(const Scene& scene, Strategy strategy) {
  if (!has_points(scene, strategy)) return {};
  const char* way = strategy == Strategy::particle ? "to point labels" : "from point transceivers";
  if (strategy == Strategy::walk) return {fmt::format("all light {}", way)};

  std::vector<bool> used(scene.materials.size());
  for (const MaterialId material : scene.mesh.materials) used[material.value] = true;
  const auto names = [&](const std::function<bool(const Material&)>& wanted) {
    std::vector<std::string> found;
    for (std::size_t m = 0; m < scene.materials.size(); ++m)
      if (used[m] && wanted(scene.materials[m].material)) found.push_back(scene.materials[m].name);
    return found;
  };

  std::vector<std::string> result;
  const PlaneMirrors mirrors(scene);
  if (mirrors.size() > 1)
    result.push_back(fmt::format("light {} over two or more mirrors in succession ({})", way,
                                 fmt::join(names(mirrors_a_share), ", ")));
  if (const auto solids = names(refracts_smoothly); !solids.empty())
    result.push_back(fmt::format("light {} refracted by solid glass ({})", way, fmt::join(solids, ", ")));
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    if (mirrors.left_out()[m] > 0)
      result.push_back(fmt::format("light {} over {} small mirrors of '{}'", way, mirrors.left_out()[m],
                                   scene.materials[m].name));
  return result;
}

}  // namespace shelfbeam
