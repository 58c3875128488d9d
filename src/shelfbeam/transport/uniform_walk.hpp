#pragma once

#include <cstdint>
#include <span>

#include "shelfbeam/transport/direct.hpp"

namespace shelfbeam {

/// What a walk needs to know of the scene.
struct WalkScene {
  const Scene& scene;
  const RayScene& rays;
  const Emitters& emitters;
};

/// Identifies one walk: its random numbers follow from this alone.
struct WalkKey {
  std::uint64_t stream = 0;  ///< of seed and label
  std::uint32_t batch = 0;
  std::uint32_t sample = 0;  ///< within the batch
};

/// One sample of the paper's estimator for one label (2.7.2 started at the sensor, with the errata): a random
/// walk from the label; at every vertex, the label's own included, next event estimation with one transceiver
/// chosen uniformly among n, so p_e = 1/n; Russian roulette on the throughput (2.18).
///
/// Adds the contributions to `reflected` and, those of the label's own vertex, to `direct` (n entries each).
/// With an empty `direct` that first connection is left out: its expectation is then added in closed form.
/// Returns the number of rays traced.
std::uint64_t uniform_walk(const WalkScene& world, const Label& label, const WalkKey& key,
                           std::span<double> reflected, std::span<double> direct);

}  // namespace shelfbeam
