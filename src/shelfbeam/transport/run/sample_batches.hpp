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

/// What one batch gives a label: the signal of every source, less what is known in closed form. Values may
/// be negative; their mean over all batches that there could be is not.
struct BatchRow {
  std::size_t label = 0;
  std::span<const double> values;  ///< one a source
};

struct BatchRun {
  std::uint32_t batches = 0;
  std::uint64_t samples_per_batch = 0;  ///< first rays a label
  std::uint64_t rays = 0;
  std::vector<float> known;  ///< m x n, row by row: signal known in closed form, to be added to every batch
};

/// Calls `take` with every row of so many batches: those of a label in their order, one at a time; of
/// different labels from several threads at once. For statistics that a signal matrix does not keep, such as
/// the spread of sums. The options' stopping rule and checkpoint play no part.
///
/// Throws InputError where the options do not fit the scene, and for particles, whose batches have no rows;
/// Interrupted when cancelled.
BatchRun sample_batches(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control = {});

}  // namespace shelfbeam
