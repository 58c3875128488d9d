#pragma once

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// Throws InputError, naming the size, when a simulation would need more than `options.memory`. The first,
/// which needs no more than the scene, counts what is sure before anything large is made; the second counts
/// everything.
void expect_room(const Scene& scene, const SimulationOptions& options, bool keeps_matrix);
void expect_room(const World& world, const Estimator& estimator, const SimulationOptions& options,
                 bool keeps_matrix);

}  // namespace shelfbeam::detail
