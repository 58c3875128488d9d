#include "shelfbeam/transport/run/sample_batches.hpp"

#include <algorithm>
#include <numeric>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/run/batch_driver.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"
#include "shelfbeam/transport/tally/analytic_direct.hpp"

namespace shelfbeam {

namespace {

// Calls `take` for the rows of a batch.
void hand_out(const Estimator::Block& block, std::vector<BatchValues::Value> values,
              const std::function<void(const BatchRow&)>& take) {
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) { return a.entry < b.entry; });
  const std::size_t columns = block.columns.size();
  std::vector<double> row(columns);
  auto next = values.begin();
  for (std::size_t r = 0; r < block.rows.size(); ++r) {
    std::fill(row.begin(), row.end(), 0.0);
    for (; next != values.end() && next->entry < (r + 1) * columns; ++next)
      row[block.columns[next->entry - r * columns]] = next->total;
    take({block.rows[r], row});
  }
}

}  // namespace

BatchRun sample_batches(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  BatchRun run;
  run.batches = batches;
  with_threads(control.threads, [&] {
    require_memory(scene, options, false);
    const World world(scene);
    const auto estimator = make_estimator(world, options, control);
    run.samples_per_batch = estimator->samples_per_batch();
    const std::size_t rows = world.receivers.size(), columns = world.emitters.size();
    const detail::AnalyticDirect known(world, options.rules(), control);
    if (!known.is_complete()) throw Interrupted("the simulation was stopped");
    run.known.resize(rows * columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        run.known[i * columns + j] = static_cast<float>(known.straight(i, j) + known.mirrored(i, j));
    for (std::size_t item = 0; item < estimator->items(); ++item)
      if (estimator->block(item).columns.size() != columns)
        throw InputError("strategy particle", "does not sample whole rows", "use another strategy",
                         Setting::strategy);
    std::vector<std::uint32_t> items(estimator->items());
    std::iota(items.begin(), items.end(), 0U);
    detail::BatchDriver driver(scene, *estimator, control);
    const std::uint32_t at_once = detail::BatchDriver::at_once(items.size());
    for (std::uint32_t first = 0; first < batches && !control.cancelled(); first += at_once) {
      driver.run(
          items, first, std::min(at_once, batches - first),
          [&](std::size_t item, std::uint32_t, const BatchValues& batch) {
            hand_out(estimator->block(item), batch.values, take);
          },
          [](std::uint32_t) { return true; });
      control.report("simulating", static_cast<double>(first) / batches);
    }
    if (control.cancelled()) throw Interrupted("the simulation was stopped");
    run.rays = known.rays() + driver.rays();
  });
  return run;
}

}  // namespace shelfbeam
