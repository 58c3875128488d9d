#pragma once

#include "shelfbeam/math/box_index.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The box around all surfaces, labels and units.
inline Bounds extent(const Scene& scene) {
  Bounds box;
  for (const Vec3& vertex : scene.mesh.vertices) box.include(vertex);
  for (const Label& label : scene.labels) box.include(label.position);
  for (const Transceiver& unit : scene.transceivers) box.include(unit.position);
  return box;
}

}  // namespace shelfbeam
