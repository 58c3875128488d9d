#include "shelfbeam/transport/world/rough_coats.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "shelfbeam/transport/world/plane_mirrors.hpp"

namespace shelfbeam {

namespace {

// The same material with a rough coat, if it has a smooth one. Connections over facets of this roughness have
// a small variance, and the directions of reflections spread by some degrees only.
std::optional<Material> rough(const Material& material) {
  constexpr double roughness = 0.1;
  const auto* const plastic = std::get_if<Plastic>(&material);
  if (plastic == nullptr || plastic->facets) return std::nullopt;
  return make_plastic(plastic->ior, plastic->reflectance,
                      make_microfacets(FacetDistribution::ggx, roughness, roughness));
}

}  // namespace

std::optional<Scene> with_rough_coats(const Scene& scene) {
  std::vector<bool> used = scene.used_materials();
  for (const EmittingSurface& surface : scene.emitting_surfaces) used[surface.material.value] = false;
  std::vector<std::optional<NamedMaterial>> changed(scene.materials.size());
  for (std::size_t m = 0; m < changed.size(); ++m) {
    if (!used[m]) continue;
    if (auto material = rough(scene.materials[m].material)) {
      changed[m] = scene.materials[m];
      changed[m]->material = std::move(*material);
    }
  }
  if (std::none_of(changed.begin(), changed.end(), [](const auto& one) { return one.has_value(); }))
    return std::nullopt;
  const PlaneMirrors mirrors(scene);
  std::optional<Scene> result;
  std::vector<std::optional<MaterialId>> added(changed.size());
  for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t) {
    const std::uint32_t m = scene.mesh.materials[t].value;
    if (!changed[m] || mirrors.contains(t)) continue;
    if (!result) result = scene;
    if (!added[m]) {
      added[m] = MaterialId{static_cast<std::uint32_t>(result->materials.size())};
      result->materials.push_back(*changed[m]);
    }
    result->mesh.materials[t] = *added[m];
  }
  return result;
}

}  // namespace shelfbeam
