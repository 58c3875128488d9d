#include "shelfbeam/transport/run/sample_batches.hpp"

#include <algorithm>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/transport/run/batch_driver.hpp"

namespace shelfbeam {

namespace {

// Calls `take` for the rows of a batch. `position` maps labels to their positions in the request.
void hand_out(const Estimator::Block& block, std::vector<BatchValues::Value> values,
              std::span<const std::uint32_t> position, const std::function<void(const BatchRow&)>& take) {
  std::sort(values.begin(), values.end(), [](const auto& a, const auto& b) { return a.entry < b.entry; });
  const std::size_t columns = block.columns.size();
  std::vector<double> row(columns);
  auto next = values.begin();
  for (std::size_t r = 0; r < block.rows.size(); ++r) {
    std::fill(row.begin(), row.end(), 0.0);
    for (; next != values.end() && next->entry < (r + 1) * columns; ++next)
      row[block.columns[next->entry - r * columns]] = next->total;
    take({position[block.rows[r]], row});
  }
}

void sample(const PreparedScene& prepared, const BatchRequest& request, BatchRun& run,
            const std::function<void(const BatchRow&)>& take, const RunControl& control) {
  const auto estimator = prepared.estimator().part(request.labels, request.seed, request.min_samples);
  run.batches = request.batches;
  run.samples_per_batch = estimator->samples_per_batch();
  const std::size_t columns = prepared.world().emitters.size();
  std::vector<std::uint32_t> position(prepared.world().receivers.size());
  run.known.reserve(request.labels.size() * columns);
  for (const LabelId i : request.labels) {
    position[i] = static_cast<std::uint32_t>(run.known.size() / std::max<std::size_t>(1, columns));
    for (std::size_t j = 0; j < columns; ++j)
      run.known.push_back(
          static_cast<float>(prepared.direct().straight(i, j) + prepared.direct().mirrored(i, j)));
  }
  const std::vector<std::uint32_t> items = all_numbers(estimator->items());
  if (items.empty()) return;
  detail::BatchDriver driver(prepared.world().scene, *estimator, control);
  const std::uint32_t at_once = detail::BatchDriver::at_once(items.size());
  const std::uint32_t end = request.first + request.batches;
  for (std::uint32_t first = request.first; first < end && !control.cancelled(); first += at_once) {
    driver.run(
        items, first, std::min(at_once, end - first),
        [&](std::size_t item, std::uint32_t, const BatchValues& batch) {
          hand_out(estimator->block(item), batch.values, position, take);
        },
        [](std::uint32_t) { return true; });
    control.report(Task::simulating, static_cast<double>(first - request.first) / request.batches);
  }
  if (control.cancelled()) throw Interrupted("the simulation was stopped");
  run.rays = driver.rays();
}

}  // namespace

BatchRun sample_batches(const PreparedScene& prepared, const BatchRequest& request,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  BatchRun run;
  with_threads(control.threads, [&] { sample(prepared, request, run, take, control); });
  return run;
}

BatchRun sample_batches(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control) {
  const auto prepared = prepare(scene, options, false, control);
  const std::vector<LabelId> labels = all_numbers<LabelId>(scene.labels.size());
  BatchRun run = sample_batches(*prepared, {labels, options.seed, batches}, take, control);
  run.rays += prepared->direct().rays();
  return run;
}

}  // namespace shelfbeam
