#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
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
  std::vector<float> known;  ///< by rows: analytic direct light, to be added to every batch
};

/// Independent batches of some labels.
struct BatchRequest {
  std::span<const LabelId> labels;  ///< ascending
  std::uint64_t seed = 0;           ///< differs from those of all other batches of the scene
  std::uint32_t batches = 0;
  std::uint32_t first = 0;        ///< number of the first batch
  std::uint64_t min_samples = 1;  ///< per batch and label, where the estimator's number is free
};

/// Calls `take` with every row of the batches: for one label in order, one at a time; for different labels
/// from several threads at once. BatchRow::label is the position of the label in the request. This serves
/// statistics that a signal matrix does not keep, such as the spread of sums.
///
/// Throws InputError for particles, whose batches have no rows; Interrupted when cancelled.
BatchRun sample_batches(const PreparedScene& prepared, const BatchRequest& request,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control = {});

/// All labels of a scene that is prepared for this purpose, with the seed of the options, whose stopping rule
/// and checkpoint are ignored. Throws as `prepare`, too.
BatchRun sample_batches(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control = {});

}  // namespace shelfbeam
