#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include "shelfbeam/material/material.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

namespace shelfbeam {

/// Ends of the ranges of reflectances (NamedMaterial::reflectance_range). No signal is smaller where a
/// surface reflects more, so a plan that holds at the low ends holds everywhere within the ranges.
enum class RangeEnd : std::size_t { low = 0, high = 1 };

/// A store or a scene in which every material with a range is at an end of it.
template <class T>
T with_reflectances_at(RangeEnd end, T shop) {
  for (NamedMaterial& material : shop.materials)
    if (material.reflectance_range)
      material.material =
          with_reflectance(material.material, (*material.reflectance_range)[static_cast<std::size_t>(end)]);
  return shop;
}

/// Whether a plan over the states of a store has its reflectances at the low ends.
inline bool varies_reflectances(const Store& store) {
  return !store.variation || store.variation->varies(Cause::reflectance);
}

/// The store, or a scene of it, with the reflectances of a plan over its states.
template <class T>
T with_reflectances_for_states(const Store& store, T shop) {
  return varies_reflectances(store) ? with_reflectances_at(RangeEnd::low, std::move(shop)) : shop;
}

template <class T>
bool has_reflectance_range(const T& shop) {
  return std::any_of(shop.materials.begin(), shop.materials.end(),
                     [](const NamedMaterial& material) { return material.reflectance_range.has_value(); });
}

}  // namespace shelfbeam
