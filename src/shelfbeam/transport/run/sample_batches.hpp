#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// One batch of a label: the signal of every source without the analytic direct light. Values may be
/// negative; their expectation is not.
struct BatchRow {
  std::size_t label = 0;
  std::span<const double> values;  ///< one per source
};

struct BatchRun {
  std::uint32_t batches = 0;
  std::uint64_t samples_per_batch = 0;  ///< first rays per label
  std::uint64_t rays = 0;
  std::vector<float> known;  ///< m x n, by rows: analytic direct light, to be added to every batch
};

/// Calls `take` with every row of `batches` batches: for one label in order, one at a time; for different
/// labels from several threads at once. This serves statistics that a signal matrix does not keep, such as
/// the spread of sums. Ignores the options' stopping rule and checkpoint.
///
/// Throws InputError if the options do not fit the scene, and for particles, whose batches have no rows;
/// Interrupted when cancelled.
BatchRun sample_batches(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control = {});

}  // namespace shelfbeam
