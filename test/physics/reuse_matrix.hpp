#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"

#include "physics/comparison.hpp"

namespace shelfbeam::test {

/// The analytic direct light, which is added to every entry of estimators that omit it, row by row.
inline std::vector<double> analytic_direct(const World& world) {
  const detail::AnalyticDirect known(world, {.strategy = Strategy::nee, .samples_direct = false}, {});
  std::vector<double> values;
  for (std::size_t i = 0; i < world.receivers.size(); ++i)
    for (std::size_t j = 0; j < world.emitters.size(); ++j)
      values.push_back(known.straight(i, j) + known.mirrored(i, j));
  return values;
}

/// One batch of all items as a matrix, row by row, without analytic direct light.
inline std::vector<double> batch_of(const Estimator& estimator, std::size_t rows, std::size_t columns,
                                    std::uint32_t batch) {
  std::vector<double> matrix(rows * columns);
  BatchValues values;
  for (std::size_t item = 0; item < estimator.items(); ++item) {
    const Estimator::Block& block = estimator.block(item);
    values.clear();
    estimator.sample(item, batch, nullptr, values);
    for (const BatchValues::Value& value : values.values)
      matrix[block.rows[value.entry / block.columns.size()] * columns +
             block.columns[value.entry % block.columns.size()]] += value.total;
  }
  return matrix;
}

/// The signal matrix by path reuse, from `factor` times 32 batches.
inline SignalMatrix reuse(const Scene& scene, std::uint32_t factor = 1, std::uint64_t seed = 1,
                          const ReuseEffort& effort = {}) {
  const World world(scene);
  const ReuseEstimator estimator(world, seed, effort);
  const std::vector<double> known = analytic_direct(world);
  std::vector<Moments> moments(known.size());
  for (std::uint32_t b = 0; b < batch_count * factor; ++b) {
    const std::vector<double> batch = batch_of(estimator, world.receivers.size(), world.emitters.size(), b);
    for (std::size_t e = 0; e < batch.size(); ++e) moments[e].add(batch[e]);
  }
  SignalMatrix matrix;
  matrix.labels.resize(world.receivers.size());
  matrix.transceivers.resize(world.emitters.size());
  for (std::size_t e = 0; e < known.size(); ++e) {
    matrix.mean.push_back(static_cast<float>(known[e] + moments[e].mean()));
    matrix.standard_error.push_back(static_cast<float>(moments[e].standard_error()));
  }
  return matrix;
}

}  // namespace shelfbeam::test
