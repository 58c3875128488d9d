#include "shelfbeam/transport/run/memory.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/transport/run/engine.hpp"

namespace shelfbeam::detail {

namespace {

// Three floats and a flag an entry, two more floats for each layer; 0 where the matrix goes straight into a
// file.
double result_bytes(double entries, const SimulationOptions& options, bool keeps_matrix) {
  return keeps_matrix ? entries * (1 + sizeof(float) * (3 + 2 * static_cast<double>(options.layers()))) : 0;
}

void expect_at_most(double needed, std::size_t labels, std::size_t sources,
                    const SimulationOptions& options) {
  if (options.memory == 0 || needed <= static_cast<double>(options.memory)) return;
  throw InputError("--memory",
                   fmt::format("{} labels and {} candidates need {:.3g} GB, {:.3g} GB may be used", labels,
                               sources, needed / 1e9, static_cast<double>(options.memory) / 1e9),
                   "allow more, or use a wider grid of candidates");
}

}  // namespace

void expect_room(const Scene& scene, const SimulationOptions& options, bool keeps_matrix) {
  const std::size_t sources = scene.transceivers.size() + scene.emitting_surfaces.size();
  const double entries = static_cast<double>(scene.labels.size()) * static_cast<double>(sources);
  double each = options.rules().samples_direct ? 0 : sizeof(float);
  each += sizeof(double) *
          static_cast<double>(ItemSums::size(1, options.rules().samples_direct, options.layers()));
  if (options.estimator == EstimatorKind::uniform) each += sizeof(std::uint32_t);  // a column index
  expect_at_most(entries * each + result_bytes(entries, options, keeps_matrix), scene.labels.size(), sources,
                 options);
}

void expect_room(const World& world, const Estimator& estimator, const SimulationOptions& options,
                 bool keeps_matrix) {
  const std::size_t labels = world.receivers.size(), sources = world.emitters.size();
  const std::size_t own = Engine::bytes(world, estimator, options) +
                          KnownLight::bytes(world, options.rules()) + estimator.bytes();
  const double entries = static_cast<double>(labels) * static_cast<double>(sources);
  expect_at_most(static_cast<double>(own) + result_bytes(entries, options, keeps_matrix), labels, sources,
                 options);
}

}  // namespace shelfbeam::detail
