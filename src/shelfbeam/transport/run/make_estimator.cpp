#include "shelfbeam/transport/run/make_estimator.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <limits>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/transport/reuse/reuse.hpp"
#include "shelfbeam/transport/run/batch_scheduler.hpp"
#include "shelfbeam/transport/tally/estimator_share.hpp"
#include "shelfbeam/transport/uniform/uniform.hpp"

namespace shelfbeam {

namespace {

void expect_possible(const Scene& scene, const SimulationOptions& options) {
  if (!options.part.is_whole()) {
    if (!options.has_fixed_samples())
      throw InputError("part of a simulation",
                       "requires a number of samples: errors and times of one part "
                       "do not decide about the others",
                       "set the number of samples", Setting::part);
    if (options.rules().strategy == Strategy::particle)
      throw InputError("part of a simulation", "requires walks from labels",
                       "use a strategy other than particle", Setting::strategy);
  }
  if (options.estimator == EstimatorKind::reuse) {
    if (options.needs_uniform())
      throw InputError("estimator reuse", "supports neither strategies nor matrices by bounces or lengths",
                       "remove these options, or use the estimator uniform", Setting::estimator);
    return;
  }
  if (options.by_bounce && options.max_bounces == PathRules::no_limit)
    throw InputError("matrices by number of bounces", "require a maximum number of bounces", "set it",
                     Setting::bounces);
  if (options.by_length.count > 0 && options.strategy == Strategy::particle)
    throw InputError("matrices by path length", "require walks from labels",
                     "use a strategy other than particle", Setting::strategy);
  if (options.by_length.count > 0 && options.direct == DirectLight::exact)
    throw InputError("matrices by path length", "require sampled direct light", "sample it",
                     Setting::direct_light);
  if (options.strategy != Strategy::walk) return;
  for (const Transceiver& unit : scene.transceivers)
    if (scene.type_of(unit).radius == 0)
      throw InputError("strategy walk",
                       fmt::format("never hits transceiver {}: its type {} is a point", in_quotes(unit.id),
                                   in_quotes(scene.type_of(unit).name)),
                       "give the type a radius, or use another strategy", Setting::strategy);
}

// Counts `work` bytes and, if the matrix is kept in memory, three floats and a flag per entry and two more
// floats per layer.
void expect_at_most(double work, std::size_t labels, std::size_t sources, const SimulationOptions& options,
                    bool keeps_matrix) {
  const double entries = static_cast<double>(labels) * static_cast<double>(sources);
  const double each = 1 + sizeof(float) * (3 + 2 * static_cast<double>(options.layers()));
  const double needed = work + (keeps_matrix ? entries * each : 0);
  if (options.memory == 0 || needed <= static_cast<double>(options.memory)) return;
  throw InputError("memory",
                   fmt::format("{} labels and {} candidates require {:.3g} GB; the limit is {:.3g} GB",
                               labels, sources, needed / 1e9, static_cast<double>(options.memory) / 1e9),
                   "raise it, or use a wider grid of candidates", Setting::memory);
}

std::unique_ptr<Estimator> make_whole(const World& world, const SimulationOptions& options,
                                      const RunControl& control) {
  if (options.estimator == EstimatorKind::reuse) {
    ReuseEffort effort;
    effort.survival = std::max(effort.survival, survival_at(options.brightest));
    return std::make_unique<ReuseEstimator>(world, options.seed, effort, control);
  }
  return std::make_unique<UniformEstimator>(world, options.rules(), options.seed,
                                            options.uniform_samples_per_batch(), options.by_bounce,
                                            options.by_length);
}

}  // namespace

std::unique_ptr<Estimator> make_estimator(const World& world, const SimulationOptions& options,
                                          const RunControl& control) {
  expect_possible(world.scene, options);
  auto estimator = make_whole(world, options, control);
  const auto [number, count] = options.part;
  if (count == 1) return estimator;
  if (estimator->items() < count)
    throw InputError("part of a simulation",
                     fmt::format("is too small: the labels form {} groups", estimator->items()),
                     fmt::format("use at most {} parts", estimator->items()), Setting::part);
  return std::make_unique<detail::EstimatorShare>(std::move(estimator), number - 1, count);
}

std::optional<PathRules> rules_of_estimator(std::string_view name) {
  constexpr std::string_view of_labels = "uniform ", limit = ", at most ";
  if (name.starts_with("reuse")) return SimulationOptions().rules();
  if (name.starts_with(of_labels)) name.remove_prefix(of_labels.size());
  const auto strategy = from_text<Strategy>(name.substr(0, name.find_first_of(" ,")));
  if (!strategy) return {};
  PathRules rules{.strategy = *strategy};
  if (const std::size_t at = name.find(limit); at != std::string_view::npos) {
    const std::string_view number = name.substr(at + limit.size());
    const auto [end, error] =
        std::from_chars(number.data(), number.data() + number.size(), rules.max_bounces);
    if (error != std::errc{}) return {};
  }
  return rules;
}

std::uint32_t batches_for(const Estimator& estimator, const SimulationOptions& options) {
  if (options.time_s) return std::numeric_limits<std::uint32_t>::max();
  if (!options.relative_error && options.estimator == EstimatorKind::uniform) return batch_count;
  const std::uint64_t samples =
      options.relative_error ? options.relative_error->max_samples : options.samples;
  const std::uint64_t each = estimator.samples_per_batch();
  return std::max(min_batches, static_cast<std::uint32_t>((samples + each - 1) / each));
}

void require_memory(const Scene& scene, const SimulationOptions& options, bool keeps_matrix) {
  const std::size_t sources = scene.transceivers.size() + scene.emitting_surfaces.size();
  const double entries =
      static_cast<double>(scene.labels.size()) * static_cast<double>(sources) / options.part.count;
  double each = options.rules().samples_direct ? 0 : sizeof(float);
  each += sizeof(double) *
          static_cast<double>(ItemSums::size(1, options.rules().samples_direct, options.layers()));
  if (options.estimator == EstimatorKind::uniform) each += sizeof(std::uint32_t);  // a column index
  expect_at_most(entries * each, scene.labels.size(), sources, options, keeps_matrix);
}

void require_memory(const World& world, const Estimator& estimator, const SimulationOptions& options,
                    bool keeps_matrix) {
  const std::size_t own = detail::BatchScheduler::bytes(world, estimator, options) +
                          detail::AnalyticDirect::bytes(world, options.rules()) + estimator.bytes();
  expect_at_most(static_cast<double>(own), world.receivers.size(), world.emitters.size(), options,
                 keeps_matrix);
}

}  // namespace shelfbeam
