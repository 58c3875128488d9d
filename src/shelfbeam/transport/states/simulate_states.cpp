#include "shelfbeam/transport/states/simulate_states.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/signal/parts/state_summary.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"

namespace shelfbeam {

namespace {

std::uint64_t seed_of(std::uint64_t seed, std::uint64_t state) {
  return mix_key(mix_key(seed, hash64("state")), state);
}

SignalLayer simulate_state(const Scene& scene, const PreparedScene& first, const SimulationOptions& options,
                           std::uint32_t batches, const RunControl& control) {
  const PreparedScene prepared(scene, first, options, control);
  const std::size_t m = scene.labels.size(), n = scene.transceivers.size();
  const std::vector<LabelId> labels = all_numbers<LabelId>(m);
  std::vector<PowerSums> sums(m * n);
  const BatchRun run = sample_batches(
      prepared, {labels, options.seed, batches},
      [&](const BatchRow& row) {
        for (std::size_t j = 0; j < n; ++j) sums[row.label * n + j].add(row.values[j]);
      },
      control);
  SignalLayer layer;
  layer.mean.resize(m * n);
  layer.standard_error.resize(m * n);
  for (std::size_t i = 0; i < m; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t e = i * n + j;
      // Requirements contain the sensitivities of the nominal shop.
      const double factor =
          scene.labels[i].relative_sensitivity / first.world().scene.labels[i].relative_sensitivity;
      layer.mean[e] = static_cast<float>(factor * (sums[e].mean() + static_cast<double>(run.known[e])));
      layer.standard_error[e] = static_cast<float>(factor * sums[e].standard_error());
    }
  return layer;
}

// A key of the labels and candidates for which states are simulated.
std::uint64_t key_of(const Scene& scene, std::uint32_t batches, std::string_view purpose) {
  std::string text = fmt::format("{}\n{}\n", purpose, batches);
  for (const Label& label : scene.labels) text += label.id + '\n';
  text += '\n';
  for (const Transceiver& unit : scene.transceivers) text += key_text(unit);
  return hash64(text);
}

std::string bytes_of(const SignalLayer& layer) {
  std::string bytes;
  for (const auto* values : {&layer.mean, &layer.standard_error})
    bytes.append(reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float));
  return bytes;
}

// nullopt for a result of another size, as a collision of keys would give.
std::optional<SignalLayer> layer_of(std::string_view bytes, std::size_t entries) {
  const std::size_t size = entries * sizeof(float);
  if (bytes.size() != 2 * size) return std::nullopt;
  SignalLayer layer;
  layer.mean.resize(entries);
  layer.standard_error.resize(entries);
  std::memcpy(layer.mean.data(), bytes.data(), size);
  std::memcpy(layer.standard_error.data(), bytes.data() + size, size);
  return layer;
}

// Consecutive states.
StateRange part_of(StateRange range, const Share& part) {
  if (part.count > range.count)
    throw InputError("part of a simulation", fmt::format("is too small: there are {} states", range.count),
                     fmt::format("use at most {} parts", range.count), Setting::part);
  const auto start = [&](std::uint64_t number) {
    return static_cast<std::uint32_t>(number * range.count / part.count);
  };
  const std::uint32_t begin = start(part.number - 1);
  range.count = start(part.number) - begin;
  range.first += begin;
  return range;
}

}  // namespace

std::string key_text(const Transceiver& unit) {
  const auto& [x, y, z] = unit.position;
  const auto& [ax, ay, az] = unit.axis;
  return fmt::format("{} {} {} {} {} {} {} {} {} {}\n", unit.id, unit.type.value, x, y, z, ax, ay, az,
                     unit.roll_deg, unit.relative_power);
}

ResultLog log_of_states(const std::filesystem::path& path, const std::string& store_hash,
                        const SimulationOptions& options) {
  const CheckpointIdentity identity{
      {"program version", std::string(program_version())},
      {"store hash", store_hash},
      {"seed", fmt::format("{}", options.seed)},
      {"estimator",
       fmt::format("{}, direct {}, {}, {}, {} bounces, {} samples per batch", to_text(options.estimator),
                   to_text(options.direct), to_text(options.strategy), to_text(options.heuristic),
                   options.max_bounces, options.uniform_samples_per_batch())}};
  return {path, identity, options.checkpoint.resume, options.checkpoint.interval_s};
}

void simulate_states(const StateMaker& states, const PreparedScene& first, const SimulationOptions& options,
                     const StateRange& range, const std::function<void(const StateSignals&)>& use,
                     ResultLog& log, std::string_view purpose, const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  const Scene& nominal = first.world().scene;
  const std::uint64_t key = key_of(nominal, range.batches, purpose);
  const std::size_t entries = nominal.labels.size() * nominal.transceivers.size();
  for (std::uint32_t k = 0; k < range.count; ++k) {
    const std::uint64_t state = range.first + k, state_key = mix_key(key, state);
    control.report(Task::simulating_states, static_cast<double>(k) / range.count);
    if (control.cancelled()) throw Interrupted("the simulation was stopped");
    if (const auto kept = log.find(state_key))
      if (const auto layer = layer_of(*kept, entries)) {
        use({state, *layer});
        continue;
      }
    const Scene scene = make_scene(states(state));
    SimulationOptions own = options;
    own.seed = seed_of(options.seed, state);
    RunControl quiet = control;
    quiet.progress = nullptr;
    SignalLayer layer;
    with_threads(control.threads, [&] { layer = simulate_state(scene, first, own, range.batches, quiet); });
    log.add(state_key, bytes_of(layer));
    use({state, layer});
  }
}

namespace {

// `max_hard`: nothing for the states of a plan.
StoredSignals summary_of_states(const Store& store, const Scene& scene, const SimulationOptions& options,
                                const StateRange& range, std::optional<std::size_t> max_hard, ResultLog& log,
                                const RunControl& control) {
  const StoreStates states(store, scene, options.seed);
  SimulationOptions whole = options;
  whole.part = {};
  const auto first = prepare(scene, whole, true, control);
  const std::size_t rows = scene.labels.size();
  const StateRange own = part_of(range, options.part);
  const bool keeps_all = !max_hard || !options.part.is_whole();
  detail::StateSummary summary(
      detail::matrix_head(scene, scene.store_hash, options.seed, first->estimator().name() + ", states"),
      keeps_all ? rows : *max_hard);
  const auto add = [&](const StateSignals& state) {
    summary.add(state.signals.mean, max_hard ? std::span<const float>() : state.signals.standard_error);
  };
  simulate_states([&](std::uint64_t k) { return states.state(k); }, *first, whole, own, add, log,
                  max_hard ? "states" : planning_states, control);
  StoredSignals found = std::move(summary).result();
  if (keeps_all) {
    found.part = {options.part.number, options.part.count, std::vector<std::uint32_t>(own.count),
                  static_cast<std::uint32_t>(max_hard.value_or(rows))};
    std::iota(found.part->members.begin(), found.part->members.end(), static_cast<std::uint32_t>(own.first));
  }
  const std::size_t n = found.columns();
  found.direct.resize(rows * n);
  for (std::size_t e = 0; e < found.direct.size(); ++e)
    found.direct[e] = static_cast<float>(first->direct().straight(e / n, e % n));
  return found;
}

}  // namespace

StoredSignals simulate_states(const Store& store, const Scene& scene, const SimulationOptions& options,
                              const StateRange& range, std::size_t max_hard, ResultLog& log,
                              const RunControl& control) {
  return summary_of_states(store, scene, options, range, max_hard, log, control);
}

StoredSignals simulate_planning_states(const Store& store, const Scene& scene,
                                       const SimulationOptions& options, const StateRange& range,
                                       ResultLog& log, const RunControl& control) {
  return summary_of_states(store, scene, options, range, std::nullopt, log, control);
}

}  // namespace shelfbeam
