#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The scene with some of its labels, in the given order. Their signals have the same distribution as in the
/// whole scene, because devices do not block light.
inline Scene sub_scene(const Scene& scene, std::span<const LabelId> labels) {
  Scene part = scene;
  part.store_hash.clear();
  part.labels.clear();
  for (const LabelId i : labels) part.labels.push_back(scene.labels[i]);
  return part;
}

/// The scene with some of its labels and transceivers.
inline Scene sub_scene(const Scene& scene, std::span<const LabelId> labels,
                       std::span<const ColumnId> transceivers) {
  Scene part = sub_scene(scene, labels);
  part.transceivers.clear();
  for (const std::uint32_t j : transceivers) part.transceivers.push_back(scene.transceivers[j]);
  return part;
}

/// The scene with all of its labels and some of its transceivers.
inline Scene with_units(const Scene& scene, std::span<const ColumnId> transceivers) {
  return sub_scene(scene, all_numbers<LabelId>(scene.labels.size()), transceivers);
}

}  // namespace shelfbeam
