#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/material/material.hpp"
#include "shelfbeam/scene/plan_parts.hpp"

namespace shelfbeam {

namespace {

// The materials that the store names, whether or not they have a surface.
std::vector<bool> named_materials(const Store& store, const Scene& scene) {
  std::vector<bool> named = scene.used_materials();
  const auto use = [&](MaterialId material) { named[material.value] = true; };
  for (const auto& [fixture, where] : store.fixtures)
    for (const MaterialId material : materials_of(fixture)) use(material);
  if (store.variation)
    for (const StandingBoxes& boxes : store.variation->boxes) use(boxes.material);
  return named;
}

void warn_of_materials(const Inspected& store, WarningList& warnings) {
  const Scene& scene = store.scene;
  const std::vector<bool> named = named_materials(store.store, scene);
  for (std::size_t k = 0; k < named.size(); ++k) {
    const auto& [name, material, range] = scene.materials[k];
    if (!named[k]) {
      if (k >= store.store.shared.materials)
        warnings.add(FindingCode::material_unused, fmt::format("{}: materials.{}", store.store.file, name),
                     "no surface has it; remove it, or name it where it belongs");
    } else if (const auto reflectance = given_reflectance(material); reflectance && *reflectance < 0.02) {
      warnings.add(FindingCode::material_dark,
                   fmt::format("{}: materials.{}.reflectance", store.store.file, name),
                   "is {:.3g}; 0.03 (black paint) to 0.95 are typical; "
                   "give a fraction, such as 0.8 for 80 %",
                   *reflectance);
    }
  }
}

// Whether an area contains a part of the room. It need not have one.
bool meets_room(const KeepOut& area, const RoomShape& room) {
  Polygon plan = area.polygon;
  if (plan.empty()) plan = {area.min, {area.max[0], area.min[1]}, area.max, {area.min[0], area.max[1]}};
  const std::vector<PlanPart> parts = plan_parts(room, plan);
  return parts.empty() || std::any_of(parts.begin(), parts.end(),
                                      [](const PlanPart& part) { return part.ceiling != nullptr; });
}

void warn_of_keep_out(const Inspected& store, WarningList& warnings) {
  const Vec3 &low = store.scene.lower, &high = store.scene.upper;
  for (const auto& [area, where] : store.store.keep_out) {
    store.expect_running();
    const Vec2 &min = area.min, &max = area.max;
    if (max[0] >= low.x && max[1] >= low.y && min[0] <= high.x && min[1] <= high.y) {
      if (store.scene.room && !meets_room(area, *store.scene.room))
        warnings.add(FindingCode::keep_out_outside, where,
                     "from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) is "
                     "outside the walls of the room; it removes no candidate; move it inside",
                     min[0], min[1], max[0], max[1]);
      continue;
    }
    warnings.add(FindingCode::keep_out_outside, where,
                 "extends from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}), but "
                 "the shop from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}); it removes no candidate; "
                 "check its unit of length",
                 min[0], min[1], max[0], max[1], low.x, low.y, high.x, high.y);
  }
}

// The share of devices, up to 200 of them, from which a vertical ray meets no surface.
template <class Devices>
double open_share(const Inspected& store, const Devices& devices, const Vec3& direction) {
  constexpr std::size_t most = 200;
  const std::size_t count = std::min(devices.size(), most);
  std::size_t open = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const Vec3& p = devices[k * devices.size() / count].position;
    if (!store.rays.intersect({p, direction}, direction)) ++open;
  }
  return static_cast<double>(open) / static_cast<double>(count);
}

// A building that is a mesh may lack a part, or stand at another place than its fixtures.
void warn_of_open_building(const Inspected& store, WarningList& warnings) {
  constexpr double many = 0.1;
  const auto warn = [&](double share, std::string_view devices, std::string_view surface) {
    if (share > many)
      warnings.add(FindingCode::room_open, store.store.file + ": fixtures",
                   "{:.0f} % of the {} have no surface {} them; a floor and a ceiling are typical; "
                   "add a 'room', or check which parts of the building the mesh contains and where it stands",
                   100 * share, devices, surface);
  };
  warn(open_share(store, store.scene.labels, {0, 0, -1}), "labels", "below");
  warn(open_share(store, store.scene.transceivers, {0, 0, 1}), "transceivers", "above");
}

double highest(const CeilingHeight& ceiling, const Polygon& polygon) {
  double top = 0;
  for (const Vec2& corner : polygon) top = std::max(top, ceiling.at(corner));
  return top;
}

void warn_of_heights(const Inspected& store, WarningList& warnings) {
  const auto check = [&](const std::string& key, const std::string& what, double height, bool has_least) {
    constexpr double least = 2, most = 15;
    if (height > most || (has_least && height < least))
      warnings.add(FindingCode::room_height, fmt::format("{}: {}", store.store.file, key),
                   "{} is {:.3g} m high; 2.5 to 12 m are typical; check its unit of length", what, height);
  };
  const Scene& scene = store.scene;
  if (!scene.room) {
    // Low fixtures may be all that the store describes.
    check("fixtures", "the shop", scene.upper.z - scene.lower.z, false);
    return;
  }
  const RoomShape& room = *scene.room;
  check(room.is_box ? "room.size[2]" : "room.height", "the shop", highest(room.height, room.outline), true);
  for (std::size_t k = 0; k < room.zones.size(); ++k)
    check(fmt::format("room.zones[{}].height", k), "zone " + in_quotes(room.zones[k].id),
          highest(room.zones[k].height, room.zones[k].polygon), true);
}

}  // namespace

void warn_of_room(const Inspected& store, WarningList& warnings) {
  const Scene& scene = store.scene;
  warn_of_heights(store, warnings);
  if (scene.wavelength_nm < 700 || scene.wavelength_nm > 1700)
    warnings.add(FindingCode::wavelength, store.store.file + ": wavelength_nm",
                 "{:g} nm is not near-infrared light; 850 to 950 nm are typical; "
                 "correct it",
                 scene.wavelength_nm);
  if (!scene.room) warn_of_open_building(store, warnings);
  warn_of_materials(store, warnings);
  warn_of_keep_out(store, warnings);
}

}  // namespace shelfbeam
