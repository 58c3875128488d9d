#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/world/direct.hpp"

#include "physics/comparison.hpp"

namespace shelfbeam::test {

/// What direct_between_points adds to every entry, row by row.
inline std::vector<double> known_light(const World& world) {
  const std::size_t m = world.receivers.size(), n = world.emitters.size();
  std::vector<double> known(m * n);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      if (!is_point_to_point(world, i, j)) continue;
      const DirectSignal signal = direct_between_points(world, i, j, {});
      known[i * n + j] = signal.straight + signal.mirrored;
    }
  return known;
}

/// One batch of all items as a matrix, row by row, without what is known in closed form.
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

/// The signal matrix by path reuse, from `batch_count` means of `effort_factor` batches each.
inline SignalMatrix reuse(const Scene& scene, std::uint32_t effort_factor = 1, std::uint64_t seed = 1,
                          const ReuseEffort& effort = {}) {
  const World world(scene);
  const ReuseEstimator estimator(world, seed, effort);
  const std::vector<double> known = known_light(world);
  const std::size_t m = world.receivers.size(), n = world.emitters.size();
  std::vector<Moments> moments(m * n);
  for (std::uint32_t b = 0; b < batch_count; ++b) {
    std::vector<double> sum(m * n);
    for (std::uint32_t part = 0; part < effort_factor; ++part) {
      const std::vector<double> one = batch_of(estimator, m, n, b * effort_factor + part);
      for (std::size_t e = 0; e < sum.size(); ++e) sum[e] += one[e] / effort_factor;
    }
    for (std::size_t e = 0; e < sum.size(); ++e) moments[e].add(sum[e]);
  }
  SignalMatrix matrix;
  matrix.labels.resize(m);
  matrix.transceivers.resize(n);
  for (std::size_t e = 0; e < m * n; ++e) {
    matrix.mean.push_back(static_cast<float>(known[e] + moments[e].mean()));
    matrix.standard_error.push_back(static_cast<float>(moments[e].standard_error()));
  }
  return matrix;
}

/// Entry by entry, but for those that are zero for either.
inline Comparison compare(const SignalMatrix& found, const SignalMatrix& reference) {
  Comparison entries;
  for (std::size_t e = 0; e < found.mean.size(); ++e) {
    const double error = std::hypot(found.standard_error[e], reference.standard_error[e]);
    if (error > 0 || found.mean[e] != reference.mean[e]) entries.add(found.mean[e], reference.mean[e], error);
  }
  return entries;
}

}  // namespace shelfbeam::test
