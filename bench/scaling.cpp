#include "scaling.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <thread>

#include "shelfbeam/transport/run/simulate.hpp"

#include "entrants.hpp"
#include "support.hpp"

namespace shelfbeam::bench {

ThreadScaling thread_scaling(const Scene& scene, std::uint64_t batches) {
  SimulationOptions options;
  options.estimator = EstimatorKind::reuse;
  const ReuseEffort effort;
  options.samples = batches * (effort.lookups + effort.points);
  ThreadScaling found;
  found.threads = std::thread::hardware_concurrency();
  found.batches = batches;
  found.one = found.all = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    RunControl control;
    control.threads = 1;
    found.one = std::min(found.one, wall_seconds([&] { simulate(scene, options, control); }));
    control.threads = found.threads;
    found.all = std::min(found.all, wall_seconds([&] { simulate(scene, options, control); }));
  }
  return found;
}

Cost cost_of_reuse(const Scene& scene, std::size_t max_labels, std::uint64_t batches) {
  const World world(scene);
  std::unique_ptr<const ReuseEstimator> reuse;
  Cost cost;
  cost.cache_wall_seconds = wall_seconds([&] {
    cost.cache_cpu_seconds = cpu_seconds([&] { reuse = std::make_unique<const ReuseEstimator>(world, 1); });
  });
  cost.clusters = reuse->items();
  cost.cache_bytes = static_cast<double>(reuse->bytes());
  const Selection selection(*reuse, max_labels);
  cost.measured_labels = selection.labels.size();
  BatchValues values;
  const double seconds = cpu_seconds([&] {
    for (std::uint32_t batch = 0; batch < batches; ++batch)
      for (const std::size_t item : selection.items) {
        values.clear();
        reuse->sample(item, batch, nullptr, values);
      }
  });
  const double label_batches = static_cast<double>(batches) * static_cast<double>(selection.labels.size());
  cost.label_batch_seconds = seconds / label_batches;
  cost.rays = static_cast<double>(values.rays) / label_batches;
  return cost;
}

}  // namespace shelfbeam::bench
