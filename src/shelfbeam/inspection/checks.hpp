#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/scene/build/blocks.hpp"
#include "shelfbeam/scene/expect_running.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/scene/warning_list.hpp"
#include "shelfbeam/transport/world/ray_scene.hpp"

namespace shelfbeam {

/// A store and the means to examine it.
struct Inspected {
  Inspected(const Store& its_store, const Scene& its_scene, const DeviceSources& its_sources)
      : store(its_store),
        scene(its_scene),
        sources(its_sources),
        rays(scene),
        blocks(scene, 5 * Blocks::usual_visits(scene.labels.size() + scene.transceivers.size())),
        is_mesh(scene.mesh.triangles.size()) {
    const std::size_t stride = (scene.labels.size() + max_labels - 1) / max_labels;
    for (std::size_t i = 0; i < scene.labels.size(); i += stride)
      labels.push_back(static_cast<std::uint32_t>(i));
    for (const Part& part : scene.parts)
      for (std::uint32_t k = 0; k < part.triangle_count; ++k) is_mesh[part.first_triangle + k] = true;
  }

  const Store& store;
  const Scene& scene;
  const DeviceSources& sources;
  RayScene rays;
  Blocks blocks;
  /// Indices of the labels that are examined: in larger stores every second, third, ... label.
  static constexpr std::size_t max_labels = 250'000;
  std::vector<std::uint32_t> labels;
  std::vector<bool> is_mesh;  ///< for each triangle, whether it belongs to a mesh fixture

  /// Throws Interrupted if the work on the store is cancelled.
  void expect_running() const { shelfbeam::expect_running(store.cancel); }

  double floor() const { return scene.room ? 0 : scene.lower.z; }
};

/// The positions of labels or units.
template <class Devices>
BoxIndex index_of_positions(const Devices& devices) {
  return BoxIndex::over(devices, [](const auto& device) { return Bounds{device.position, device.position}; });
}

// Each function adds warnings about one subject.

/// Values outside the usual limits of their descriptions (base/fields/fields.hpp).
void warn_of_unusual_values(const Inspected& store, WarningList& warnings);
/// Requirements, responses, sizes and prices of label and transceiver types; types without devices.
void warn_of_types(const Inspected& store, WarningList& warnings);
/// The room's height, the wavelength, materials and keep-out areas.
void warn_of_room(const Inspected& store, WarningList& warnings);
/// Overlaps, floating boxes, odd scales and rotations.
void warn_of_fixtures(const Inspected& store, WarningList& warnings);
/// Labels in mid-air, out of sight, or too near to each other.
void warn_of_labels(const Inspected& store, WarningList& warnings);
/// Units that are aimed at a surface, too low, or listed twice.
void warn_of_units(const Inspected& store, WarningList& warnings);
/// Labels and units that closed walls separate from the others.
void warn_of_separated(const Inspected& store, WarningList& warnings);

}  // namespace shelfbeam
