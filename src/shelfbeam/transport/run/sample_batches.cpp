#include "shelfbeam/transport/run/sample_batches.hpp"

#include <algorithm>
#include <atomic>

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"
#include "shelfbeam/transport/run/memory.hpp"
#include "shelfbeam/transport/tally/known_light.hpp"

namespace shelfbeam {

namespace {

class BatchSampler {
 public:
  BatchSampler(const Scene& scene, const Estimator& estimator, std::size_t columns,
               const std::function<void(const BatchRow&)>& take, const RunControl& control)
      : scene_(scene),
        estimator_(estimator),
        take_(take),
        control_(control),
        row_(std::vector<double>(columns)) {
    for (std::size_t item = 0; item < estimator.items(); ++item)
      if (estimator.block(item).columns.size() != columns)
        throw InputError("--strategy particle", "has no batches of whole rows", "use another strategy");
  }

  std::uint64_t run(std::uint32_t batches) {
    // Few items take several batches at once, so that no thread waits long for another.
    constexpr std::size_t enough_tasks = 16;
    const auto at_once =
        static_cast<std::uint32_t>(std::max<std::size_t>(1, enough_tasks / estimator_.items()));
    for (std::uint32_t first = 0; first < batches && !control_.cancelled(); first += at_once) {
      sample(first, std::min(at_once, batches - first));
      control_.report("simulating", static_cast<double>(first) / batches);
    }
    if (control_.cancelled()) throw Interrupted("the simulation was stopped");
    std::uint64_t rays = 0;
    for (const BatchValues& values : values_) rays += values.rays;
    for (const BatchValues& values : waiting_) rays += values.rays;
    return rays;
  }

 private:
  void sample(std::uint32_t first_batch, std::uint32_t count) {
    const std::size_t items = estimator_.items();
    if (count > 1) waiting_.resize(std::max(waiting_.size(), items * count));
    for_parts(items * count, [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last && !control_.cancelled(); ++k) {
        BatchValues& values = count > 1 ? waiting_[k] : values_.local();
        values.clear();
        const auto batch = first_batch + static_cast<std::uint32_t>(k / items);
        if (!estimator_.sample(k % items, batch, control_.cancel, values)) return;
        expect_numbers(scene_, estimator_.block(k % items), values);
        if (count == 1) hand_out(k, values);
      }
    });
    if (count == 1 || control_.cancelled()) return;
    for_parts(items, [&](std::size_t first, std::size_t last) {
      for (std::size_t item = first; item < last; ++item)
        for (std::uint32_t b = 0; b < count; ++b) hand_out(item, waiting_[b * items + item]);
    });
  }

  void hand_out(std::size_t item, const BatchValues& values) {
    const Estimator::Block& block = estimator_.block(item);
    const std::size_t columns = block.columns.size();
    std::vector<double>& row = row_.local();
    auto next = sorted(values).begin();
    const auto end = sorted_.local().end();
    for (std::size_t r = 0; r < block.rows.size(); ++r) {
      std::fill(row.begin(), row.end(), 0.0);
      for (; next != end && next->entry < (r + 1) * columns; ++next)
        row[block.columns[next->entry - r * columns]] = next->total;
      take_({block.rows[r], row});
    }
  }

  const std::vector<BatchValues::Value>& sorted(const BatchValues& values) {
    auto& own = sorted_.local();
    own = values.values;
    const auto by_entry = [](const auto& a, const auto& b) { return a.entry < b.entry; };
    if (!std::is_sorted(own.begin(), own.end(), by_entry)) std::sort(own.begin(), own.end(), by_entry);
    return own;
  }

  const Scene& scene_;
  const Estimator& estimator_;
  const std::function<void(const BatchRow&)>& take_;
  const RunControl& control_;
  std::vector<BatchValues> waiting_;
  tbb::enumerable_thread_specific<BatchValues> values_;
  tbb::enumerable_thread_specific<std::vector<BatchValues::Value>> sorted_;
  tbb::enumerable_thread_specific<std::vector<double>> row_;
};

}  // namespace

BatchRun sample_batches(const Scene& scene, const SimulationOptions& options, std::uint32_t batches,
                        const std::function<void(const BatchRow&)>& take, const RunControl& control) {
  tbb::task_arena arena(control.threads == 0 ? tbb::task_arena::automatic
                                             : static_cast<int>(control.threads));
  const ThreadsAllowed allowed(control.threads);
  BatchRun run;
  run.batches = batches;
  arena.execute([&] {
    detail::expect_room(scene, options, false);
    const World world(scene);
    const auto estimator = make_estimator(world, options, control);
    run.samples_per_batch = estimator->samples_per_batch();
    const std::size_t rows = world.receivers.size(), columns = world.emitters.size();
    const detail::KnownLight known(world, options.rules(), control);
    if (!known.is_complete()) throw Interrupted("the simulation was stopped");
    run.known.resize(rows * columns);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j)
        run.known[i * columns + j] = static_cast<float>(known.straight(i, j) + known.mirrored(i, j));
    BatchSampler sampler(scene, *estimator, columns, take, control);
    run.rays = known.rays() + sampler.run(batches);
  });
  return run;
}

}  // namespace shelfbeam
