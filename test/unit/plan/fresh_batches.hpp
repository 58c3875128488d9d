#pragma once

#include <cstdint>
#include <vector>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam::test {

/// Batches of all labels of a scene, with the seed and samples of the options.
inline ValidationEstimates fresh_estimates(const Scene& scene, const SimulationOptions& options,
                                           std::uint32_t batches, std::size_t width, const SumRule& rule,
                                           const RunControl& control = {}) {
  const std::vector<LabelId> labels = all_numbers<LabelId>(scene.labels.size());
  return validation_estimates(*prepare(scene, options, false, control), {labels, options.seed, batches},
                              width, rule, control);
}

/// Batches of some labels, for all candidates.
inline std::vector<ValidationRow> fresh_rows(const Scene& scene, const std::vector<LabelId>& labels,
                                             const SimulationOptions& options, std::uint32_t batches) {
  return validation_rows(*prepare(scene, options, false), {labels, options.seed, batches});
}

}  // namespace shelfbeam::test
