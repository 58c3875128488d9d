#include "shelfbeam/transport/run/make_estimator.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/run/engine.hpp"
#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/uniform/uniform.hpp"

namespace shelfbeam {

namespace {

void expect_possible(const Scene& scene, const SimulationOptions& options) {
  if (options.estimator == EstimatorKind::reuse) {
    if (options.needs_uniform())
      throw InputError("estimator reuse", "has no strategies, and tells neither bounces nor lengths apart",
                       "leave such options out, or use the estimator uniform", Setting::estimator);
    return;
  }
  if (options.by_bounce && options.max_bounces == PathRules::no_limit)
    throw InputError("matrices by number of bounces", "need to know the largest number", "limit it",
                     Setting::bounces);
  if (options.by_length.count > 0 && options.strategy == Strategy::particle)
    throw InputError("matrices by path length", "are for walks from labels",
                     "use another strategy than particle", Setting::strategy);
  if (options.by_length.count > 0 && options.direct == DirectLight::exact)
    throw InputError("matrices by path length", "need direct light from the walks", "let them sample it",
                     Setting::direct_light);
  if (options.strategy != Strategy::walk) return;
  for (const Transceiver& unit : scene.transceivers)
    if (scene.type_of(unit).radius == 0)
      throw InputError("strategy walk",
                       fmt::format("never meets transceiver '{}': its type '{}' is a point", unit.id,
                                   scene.type_of(unit).name),
                       "give the type a radius, or use another strategy", Setting::strategy);
}

// The work, and of the matrix three floats and a flag an entry, two more floats for each layer; none of it
// where it goes straight into a file.
void expect_at_most(double work, std::size_t labels, std::size_t sources, const SimulationOptions& options,
                    bool keeps_matrix) {
  const double entries = static_cast<double>(labels) * static_cast<double>(sources);
  const double each = 1 + sizeof(float) * (3 + 2 * static_cast<double>(options.layers()));
  const double needed = work + (keeps_matrix ? entries * each : 0);
  if (options.memory == 0 || needed <= static_cast<double>(options.memory)) return;
  throw InputError("memory",
                   fmt::format("{} labels and {} candidates need {:.3g} GB, {:.3g} GB may be used", labels,
                               sources, needed / 1e9, static_cast<double>(options.memory) / 1e9),
                   "allow more, or use a wider grid of candidates", Setting::memory);
}

}  // namespace

std::unique_ptr<Estimator> make_estimator(const World& world, const SimulationOptions& options,
                                          const RunControl& control) {
  expect_possible(world.scene, options);
  if (options.estimator == EstimatorKind::reuse)
    return std::make_unique<ReuseEstimator>(world, options.seed, ReuseEffort{}, control);
  return std::make_unique<UniformEstimator>(world, options.rules(), options.seed,
                                            options.uniform_samples_per_batch(), options.by_bounce,
                                            options.by_length);
}

std::uint32_t batches_for(const Estimator& estimator, const SimulationOptions& options) {
  if (options.time_s) return std::numeric_limits<std::uint32_t>::max();
  if (!options.relative_error && options.estimator == EstimatorKind::uniform) return batch_count;
  const std::uint64_t samples =
      options.relative_error ? options.relative_error->most_samples : options.samples;
  const std::uint64_t each = estimator.samples_per_batch();
  return std::max(least_batches, static_cast<std::uint32_t>((samples + each - 1) / each));
}

void expect_room(const Scene& scene, const SimulationOptions& options, bool keeps_matrix) {
  const std::size_t sources = scene.transceivers.size() + scene.emitting_surfaces.size();
  const double entries = static_cast<double>(scene.labels.size()) * static_cast<double>(sources);
  double each = options.rules().samples_direct ? 0 : sizeof(float);
  each += sizeof(double) *
          static_cast<double>(ItemSums::size(1, options.rules().samples_direct, options.layers()));
  if (options.estimator == EstimatorKind::uniform) each += sizeof(std::uint32_t);  // a column index
  expect_at_most(entries * each, scene.labels.size(), sources, options, keeps_matrix);
}

void expect_room(const World& world, const Estimator& estimator, const SimulationOptions& options,
                 bool keeps_matrix) {
  const std::size_t own = detail::Engine::bytes(world, estimator, options) +
                          detail::KnownLight::bytes(world, options.rules()) + estimator.bytes();
  expect_at_most(static_cast<double>(own), world.receivers.size(), world.emitters.size(), options,
                 keeps_matrix);
}

}  // namespace shelfbeam
