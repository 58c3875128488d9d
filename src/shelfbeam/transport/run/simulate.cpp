#include "shelfbeam/transport/run/simulate.hpp"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"
#include "shelfbeam/transport/run/batch_scheduler.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam {

namespace {

// Max number of entries that a summary lists with more than the required error.
constexpr std::size_t named_entries = 10;

// The name of the signal file if it is kept elsewhere.
constexpr auto kept_name = "signal.h5";
constexpr auto too_early = "the simulation was stopped before it completed two batches of samples";

void find_unmet(const RelativeError& wanted, const detail::BatchScheduler& scheduler,
                SimulationSummary& summary) {
  auto found = scheduler.survey().shortfall(wanted, named_entries);
  if (found.precision.is_enough()) return;
  summary.unmet_error = wanted.error;
  summary.unmet = found.precision.relevant - found.precision.precise;
  summary.out_of_reach = found.precision.unreachable;
  summary.worst_unmet = std::move(found.worst);
}

SimulationSummary summarise(const SignalMatrix& head, const detail::BatchScheduler& scheduler) {
  SimulationSummary summary;
  summary.labels = head.rows();
  summary.candidates = head.columns();
  const auto by_batches = [](const LabelRow& a, const LabelRow& b) { return a.batches < b.batches; };
  const auto [least, most] = std::minmax_element(head.labels.begin(), head.labels.end(), by_batches);
  summary.min_samples = least->samples;
  summary.min_batches = least->batches;
  summary.max_samples = most->samples;
  summary.max_batches = most->batches;
  summary.batches = scheduler.batches();
  summary.resumed_batches = scheduler.resumed_batches();
  summary.has_checkpoint = scheduler.has_checkpoint();
  summary.rays = scheduler.rays();
  summary.shadow_rays = scheduler.shadow_rays();
  summary.seconds_to_halve = scheduler.seconds_to_halve();
  for (ErrorQuantiles& errors : summary.errors) {
    const auto [histogram, flagged] = scheduler.survey().errors(errors.above);
    errors.entries = histogram.count();
    errors.flagged = flagged;
    errors.median = histogram.quantile(0.5);
    errors.p90 = histogram.quantile(0.9);
    errors.p99 = histogram.quantile(0.99);
  }
  return summary;
}

// Runs a simulation and calls use(head, rows): the matrix without its entries, and the entries.
template <class Use>
SimulationSummary run(const PreparedScene& prepared, const SimulationOptions& options,
                      const RunControl& control, Use use) {
  const Estimator& estimator = prepared.estimator();
  const Scene& scene = prepared.world().scene;
  const ThreadLimit allowed(control.threads);
  SimulationSummary summary;
  with_threads(control.threads, [&] {
    const std::string hash = scene_hash(scene);
    detail::BatchScheduler scheduler(prepared, options, hash, control);
    const auto rows_so_far = [&] {
      return detail::MatrixRows(estimator, scheduler.sums(), prepared.direct(), scene.labels.size(),
                                options.bounce_layers(), options.length_layers());
    };
    const std::vector<LabelId>& simulated = prepared.labels();
    bool complete = false;
    const auto head_of = [&](const detail::MatrixRows& rows) {
      StoredSignals head{detail::matrix_head(scene, hash, options.seed, estimator.name())};
      head.length_step = options.by_length.step;
      head.provenance.complete = complete;
      for (std::size_t i = 0; i < head.rows(); ++i) {
        head.labels[i].batches = rows.batches(i);
        head.labels[i].samples = std::uint64_t{head.labels[i].batches} * estimator.samples_per_batch();
      }
      if (options.part.is_whole()) return head;
      std::vector<LabelRow> labels;
      labels.reserve(simulated.size());
      for (const LabelId i : simulated) labels.push_back(std::move(head.labels[i]));
      head.labels = std::move(labels);
      head.part = {options.part.number, options.part.count, {simulated.begin(), simulated.end()}, {}};
      return head;
    };
    try {
      complete = scheduler.run();
      const bool is_saved =
          complete ? options.checkpoint.at_end && scheduler.try_to_save() : scheduler.has_checkpoint();
      if (scheduler.fewest_batches() < 2)
        throw scheduler.has_checkpoint()
            ? Interrupted(std::string(too_early) + "; resuming continues from its checkpoint",
                          Setting::resumption)
            : Interrupted(too_early);
      if (!complete && !options.part.is_whole())
        throw Interrupted(
            "the part was stopped before it was complete; resuming continues from its checkpoint",
            Setting::resumption);
      const detail::MatrixRows rows = rows_so_far();
      StoredSignals head = head_of(rows);
      summary = summarise(head, scheduler);
      summary.complete = complete;
      summary.has_all_in_checkpoint = is_saved;
      if (complete && options.relative_error) find_unmet(*options.relative_error, scheduler, summary);
      if (options.has_fixed_samples()) summary.requested_samples = options.samples;
      use(std::move(head), rows.of(simulated));
    } catch (const OutputError& error) {
      const bool is_saved = scheduler.try_to_save();
      const bool has_checkpoint = scheduler.has_checkpoint();
      if (is_saved) throw OutputError(error, checkpoint_remains, Setting::resumption);
      std::optional<std::filesystem::path> folder;
      if (scheduler.fewest_batches() >= 2)
        folder = keep_elsewhere([&](const std::filesystem::path& elsewhere) {
          const detail::MatrixRows rows = rows_so_far();
          write_signal_file(head_of(rows), rows.of(simulated), elsewhere / kept_name);
        });
      if (!folder && !has_checkpoint) throw;
      const std::string kept =
          folder ? fmt::format("the simulated signals are kept in '{}'", (*folder / kept_name).string()) : "";
      if (!has_checkpoint) throw OutputError(error, kept, Setting::none);
      throw OutputError(error, folder ? fmt::format("{}; {}", kept, older_checkpoint) : checkpoint_remains,
                        Setting::resumption);
    }
  });
  return summary;
}

}  // namespace

SimulationResult simulate(const PreparedScene& prepared, const SimulationOptions& options,
                          const RunControl& control) {
  const Stopwatch watch;
  SimulationResult result;
  result.summary = run(prepared, options, control, [&](StoredSignals head, const SignalRows& rows) {
    result.matrix = detail::filled(std::move(head), rows);
  });
  result.summary.seconds = watch.seconds();
  return result;
}

SimulationResult simulate(const Scene& scene, const SimulationOptions& options, const RunControl& control) {
  const Stopwatch watch;
  SimulationResult result = simulate(*prepare(scene, options, true, control), options, control);
  result.summary.seconds = watch.seconds();
  return result;
}

SimulationSummary simulate_to_file(const Scene& scene, const SimulationOptions& options,
                                   const std::filesystem::path& output, const RunControl& control) {
  const Stopwatch watch;
  const auto prepared = prepare(scene, options, false, control);
  SimulationSummary summary =
      run(*prepared, options, control,
          [&](const StoredSignals& head, const SignalRows& rows) { write_signal_file(head, rows, output); });
  summary.seconds = watch.seconds();
  if (summary.complete && !options.checkpoint.path.empty()) remove_checkpoint(options.checkpoint.path);
  return summary;
}

}  // namespace shelfbeam
