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
  if (options.by_bounce && options.max_bounces == PathRules::no_limit)
    throw InputError("--by-bounce", "needs to know the largest number of bounces", "add --max-bounces");
  if (options.by_length.count > 0 && options.strategy == Strategy::particle)
    throw InputError("--by-length", "is for walks from labels", "use another strategy than 'particle'");
  if (options.by_length.count > 0 && options.direct == DirectLight::exact)
    throw InputError("--by-length", "needs direct light from the walks", "use '--direct sampled'");
  if (options.strategy != Strategy::walk) return;
  for (const Transceiver& unit : scene.transceivers)
    if (scene.type_of(unit).radius == 0)
      throw InputError("--strategy walk",
                       fmt::format("never meets transceiver '{}': its type '{}' is a point", unit.id,
                                   scene.type_of(unit).name),
                       "give the type a radius, or use another strategy");
}

}  // namespace

std::uint64_t samples_per_batch(std::uint64_t samples) {
  return std::max<std::uint64_t>(1, (samples + batch_count - 1) / batch_count);
}

std::unique_ptr<Estimator> make_estimator(const World& world, const SimulationOptions& options,
                                          const RunControl& control) {
  switch (options.estimator) {
    case EstimatorKind::uniform:
      break;
    case EstimatorKind::reuse:
      return std::make_unique<ReuseEstimator>(world, options.seed, ReuseEffort{}, control);
  }
  expect_possible(world.scene, options);
  return std::make_unique<UniformEstimator>(
      world, options.rules(), options.seed,
      options.has_fixed_samples() ? samples_per_batch(options.samples) : open_samples_per_batch,
      options.by_bounce, options.by_length);
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
