#include "shelfbeam/transport/states/simulate_states.hpp"

#include <numeric>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/matrix_rows.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"

namespace shelfbeam {

namespace {

std::uint64_t seed_of(std::uint64_t seed, std::uint32_t state) {
  return mix_key(mix_key(seed, hash64("state")), state);
}

SignalLayer simulate_state(const Scene& scene, const PreparedScene& first, const SimulationOptions& options,
                           std::uint32_t batches, const RunControl& control) {
  const PreparedScene prepared(scene, first, options, control);
  const std::size_t m = scene.labels.size(), n = scene.transceivers.size();
  std::vector<std::uint32_t> labels(m);
  std::iota(labels.begin(), labels.end(), 0U);
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
      const double factor = scene.labels[i].relative_sensitivity;
      layer.mean[e] = static_cast<float>(factor * (sums[e].mean() + static_cast<double>(run.known[e])));
      layer.standard_error[e] = static_cast<float>(factor * sums[e].standard_error());
    }
  return layer;
}

}  // namespace

void simulate_states(const StoreStates& states, const PreparedScene& first, const SimulationOptions& options,
                     const StateRange& range, const std::function<void(const StateSignals&)>& use,
                     const RunControl& control) {
  const ThreadLimit allowed(control.threads);
  for (std::uint32_t k = 0; k < range.count; ++k) {
    const std::uint32_t state = range.first + k;
    control.report("simulating states", static_cast<double>(k) / range.count);
    const Scene scene = make_scene(states.state(state));
    SimulationOptions own = options;
    own.seed = seed_of(options.seed, state);
    RunControl quiet = control;
    quiet.progress = nullptr;
    SignalLayer layer;
    with_threads(control.threads, [&] { layer = simulate_state(scene, first, own, range.batches, quiet); });
    use({state, layer});
  }
}

SignalMatrix simulate_states(const Store& store, const Scene& scene, const SimulationOptions& options,
                             const StateRange& range, const RunControl& control) {
  const auto first = prepare(scene, options, true, control);
  const StoreStates states(store, scene, options.seed);
  SignalMatrix matrix =
      detail::matrix_head(scene, scene.store_hash, options.seed, first->estimator().name() + ", states");
  simulate_states(
      states, *first, options, range,
      [&](const StateSignals& state) { matrix.by_state.push_back(state.signals); }, control);
  const std::size_t entries = matrix.rows() * matrix.columns();
  matrix.mean.resize(entries);
  matrix.standard_error.resize(entries);
  matrix.direct.resize(entries);
  for (std::size_t e = 0; e < entries; ++e) {
    Moments moments;
    for (const SignalLayer& layer : matrix.by_state) moments.add(static_cast<double>(layer.mean[e]));
    matrix.mean[e] = static_cast<float>(moments.mean());
    matrix.standard_error[e] = static_cast<float>(moments.count() > 1 ? moments.standard_error() : 0);
    const std::size_t i = e / matrix.columns(), j = e % matrix.columns();
    matrix.direct[e] = static_cast<float>(first->direct().straight(i, j));
  }
  return matrix;
}

}  // namespace shelfbeam
