#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam::bench {

/// The wall time of path reuse, including preparation, with one thread and with all.
struct ThreadScaling {
  unsigned threads = 0;     ///< all
  double one = 0, all = 0;  ///< wall time, s, minimum of three runs
  std::uint64_t batches = 0;
};

ThreadScaling thread_scaling(const Scene& scene, std::uint64_t batches);

/// The cost of path reuse in a store.
struct Cost {
  std::size_t clusters = 0, measured_labels = 0;
  double cache_cpu_seconds = 0, cache_wall_seconds = 0;  ///< all threads
  double cache_bytes = 0;
  double label_batch_seconds = 0;  ///< CPU time per label and batch, one thread
  double rays = 0;                 ///< per label and batch
};

/// Measures batches of randomly chosen clusters.
Cost cost_of_reuse(const Scene& scene, std::size_t max_labels, std::uint64_t batches);

}  // namespace shelfbeam::bench
