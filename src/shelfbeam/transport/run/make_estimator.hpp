#pragma once

#include <cstdint>
#include <memory>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam {

/// The estimator that the options ask for. Throws InputError where they do not fit the scene, Interrupted
/// when cancelled.
std::unique_ptr<Estimator> make_estimator(const World& world, const SimulationOptions& options,
                                          const RunControl& control = {});

/// The batches that give the samples asked for, or the most that a relative error may take; at least
/// `least_batches` for their spread. Any number where time decides.
std::uint32_t batches_for(const Estimator& estimator, const SimulationOptions& options);

/// Throws InputError, naming the size, when a simulation would need more than `options.memory`. The first,
/// which needs no more than the scene, counts what is sure before anything large is made; the second counts
/// everything.
void expect_room(const Scene& scene, const SimulationOptions& options, bool keeps_matrix);
void expect_room(const World& world, const Estimator& estimator, const SimulationOptions& options,
                 bool keeps_matrix);

}  // namespace shelfbeam
