#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// Creates the estimator of the options. Throws InputError if the options do not fit the scene, Interrupted
/// when cancelled.
std::unique_ptr<Estimator> make_estimator(const World& world, const SimulationOptions& options,
                                          const RunControl& control = {});

/// Strategy and max number of bounces of the estimator with this name (Estimator::name); nothing if there is
/// none.
std::optional<PathRules> rules_of_estimator(std::string_view name);

/// Max number of batches per item: the number that gives the requested samples, or max_samples of a relative
/// error; at least `min_batches`, for their spread. Unlimited with a time limit.
std::uint32_t batches_for(const Estimator& estimator, const SimulationOptions& options);

/// Throws InputError that names the size if a simulation needs more than `options.memory`. The first overload
/// needs only the scene and gives a lower bound before anything large is allocated; the second counts
/// everything.
void require_memory(const Scene& scene, const SimulationOptions& options, bool keeps_matrix);
void require_memory(const World& world, const Estimator& estimator, const SimulationOptions& options,
                    bool keeps_matrix);

}  // namespace shelfbeam
