#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// What one batch of one item gives: means over its samples, of the entries that are not zero.
struct BatchValues {
  struct Value {
    std::uint32_t entry = 0;  ///< within the item's block; each entry at most once
    double total = 0;         ///< the signal
    double direct = 0;        ///< the part of it without any reflection
  };
  struct LayerValue {
    std::uint32_t layer = 0;  ///< as SignalRows::fill_layer counts them
    std::uint32_t entry = 0;
    double value = 0;
  };

  void clear() {
    values.clear();
    layers.clear();
  }

  std::vector<Value> values;
  std::vector<LayerValue> layers;  ///< only of estimators that tell paths apart
  std::uint64_t rays = 0;          ///< traced in all; not cleared
  ShadowRays shadow_rays;          ///< of walks from labels; not cleared
};

}  // namespace shelfbeam
