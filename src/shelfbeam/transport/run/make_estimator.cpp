#include "shelfbeam/transport/run/make_estimator.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
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

}  // namespace shelfbeam
