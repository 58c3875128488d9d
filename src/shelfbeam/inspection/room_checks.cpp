#include <algorithm>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/material/material.hpp"

namespace shelfbeam {

namespace {

// The materials that the store names, whether or not they have a surface.
std::vector<bool> named_materials(const Store& store, const Scene& scene) {
  std::vector<bool> named = scene.used_materials();
  const auto use = [&](MaterialId material) { named[material.value] = true; };
  for (const auto& [fixture, where] : store.fixtures)
    std::visit(
        [&](const auto& one) {
          if constexpr (std::is_base_of_v<Shelving, std::remove_cvref_t<decltype(one)>>) {
            use(one.material);
            use(one.goods);
            if (one.doors) use(*one.doors);
          }
        },
        fixture);
  return named;
}

void warn_of_materials(const Inspected& store, WarningList& warnings) {
  const Scene& scene = store.scene;
  const std::vector<bool> named = named_materials(store.store, scene);
  for (std::size_t k = 0; k < named.size(); ++k) {
    const auto& [name, material, range] = scene.materials[k];
    if (!named[k])
      warnings.add("materials that nothing uses",
                   fmt::format("{}: materials.{}: no surface has it; remove it, or name it where it belongs",
                               store.store.file, name));
    else if (const auto reflectance = given_reflectance(material); reflectance && *reflectance < 0.02)
      warnings.add(
          "materials that reflect almost nothing",
          fmt::format("{}: materials.{}.reflectance: is {:.3g}; 0.03 (black paint) to 0.95 are usual; "
                      "give a share of 1, not per cent of it",
                      store.store.file, name, *reflectance));
  }
}

void warn_of_keep_out(const Inspected& store, WarningList& warnings) {
  const auto& areas = store.store.keep_out;
  const Vec3 &low = store.scene.lower, &high = store.scene.upper;
  for (std::size_t k = 0; k < areas.size(); ++k) {
    const auto& [min, max] = areas[k];
    if (max[0] >= low.x && max[1] >= low.y && min[0] <= high.x && min[1] <= high.y) continue;
    warnings.add(
        "keep-out areas outside the shop",
        fmt::format("{}: transceivers.keep_out[{}]: extends from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}), but "
                    "the shop from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}); an area covers candidates; "
                    "correct it, and give metres",
                    store.store.file, k, min[0], min[1], max[0], max[1], low.x, low.y, high.x, high.y));
  }
}

void warn_of_grids(const Inspected& store, WarningList& warnings) {
  constexpr double widest = 8;
  for (std::size_t g = 0; g < store.store.grids.size(); ++g) {
    const double spacing = store.store.grids[g].spacing;
    if (spacing > widest)
      warnings.add(
          "wide grids",
          fmt::format(
              "{}: transceivers.grids[{}].spacing: is {:.3g} m, which leaves few candidates to choose "
              "from; 0.5 to 3 m are usual; use a narrower spacing",
              store.store.file, g, spacing));
  }
}

}  // namespace

void warn_of_room(const Inspected& store, WarningList& warnings) {
  const Scene& scene = store.scene;
  const double height = scene.upper.z - store.floor();
  if (height > 15 || height < 2)
    warnings.add(
        "unusual heights of rooms",
        fmt::format("{}: {}: the shop is {:.3g} m high; 2.5 to 12 m are usual; correct the height, and "
                    "give metres",
                    store.store.file, scene.room ? "room.size[2]" : "fixtures", height));
  if (scene.wavelength_nm < 700 || scene.wavelength_nm > 1700)
    warnings.add(
        "unusual wavelengths",
        fmt::format("{}: wavelength_nm: {:g} nm is not near-infrared light; 850 to 950 nm are usual; "
                    "correct it",
                    store.store.file, scene.wavelength_nm));
  warn_of_materials(store, warnings);
  warn_of_keep_out(store, warnings);
  warn_of_grids(store, warnings);
}

}  // namespace shelfbeam
