#include "shelfbeam/transport/run/simulation_request.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/memory.hpp"

namespace shelfbeam {

SimulationOptions SimulationRequest::options(std::uint64_t seed, CheckpointOptions checkpoint) const {
  SimulationOptions options;
  options.estimator = kind();
  options.seed = seed;
  options.time_s = time_s;
  const auto expect_relative_error = [&](const auto& value, const char* where) {
    if (value && !relative_error)
      throw InputError(where, "has no effect without a relative error", "add one", Setting::relative_error);
  };
  if ((samples && (relative_error || time_s)) || (relative_error && time_s))
    throw InputError("the simulation", "has several of samples, relative error and time limit",
                     "give one of them");
  expect_relative_error(above, "above");
  expect_relative_error(max_samples, "max_samples");
  if (lengths && !by_length)
    throw InputError("lengths", "has no effect without a step of the path length", "add one",
                     Setting::lengths);
  if (by_length && !(std::isfinite(*by_length) && *by_length > 0))
    throw InputError("by_length", "is not a finite length above 0", "correct it", Setting::lengths);
  if (lengths && (*lengths < 1 || *lengths > max_lengths))
    throw InputError("lengths", fmt::format("is not from 1 to {}", max_lengths), "correct it",
                     Setting::lengths);
  if (by_bounce && !max_bounces)
    throw InputError("by_bounce", "has no end without a maximum number of bounces", "add one",
                     Setting::bounces);
  if (relative_error)
    options.relative_error = RelativeError{*relative_error, above.value_or(default_above),
                                           max_samples.value_or(RelativeError{}.max_samples)};
  if (samples) options.samples = *samples;
  if (options.estimator == EstimatorKind::reuse) {
    options.direct = DirectLight::exact;
  } else {
    options.direct = direct.value_or(default_direct);
    options.strategy = strategy.value_or(options.strategy);
    options.heuristic = heuristic.value_or(options.heuristic);
    options.max_bounces = max_bounces.value_or(PathRules::no_limit);
    options.by_bounce = by_bounce;
    if (by_length) options.by_length = {*by_length, lengths.value_or(default_lengths)};
  }
  options.memory = memory == 0 ? memory_limit() : memory;
  options.checkpoint = std::move(checkpoint);
  return options;
}

EstimatorKind SimulationRequest::kind() const {
  const Setting of_uniform = strategy      ? Setting::strategy
                             : heuristic   ? Setting::heuristic
                             : max_bounces ? Setting::bounces
                             : by_length   ? Setting::lengths
                             : direct      ? Setting::direct_light
                                           : Setting::none;
  if (!estimator) return of_uniform == Setting::none ? EstimatorKind::reuse : EstimatorKind::uniform;
  if (estimator == EstimatorKind::uniform) return EstimatorKind::uniform;
  if (of_uniform != Setting::none && (of_uniform != Setting::direct_light || direct == DirectLight::sampled))
    throw InputError("estimator", "is reuse, but another option applies to the estimator uniform only",
                     "remove that option, or use the estimator uniform", of_uniform);
  return EstimatorKind::reuse;
}

}  // namespace shelfbeam
