#pragma once

#include <filesystem>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"

namespace shelfbeam {

/// What to say where an output could not be written after a simulation that has a checkpoint
/// (Setting::resumption).
inline constexpr auto checkpoint_remains =
    "the checkpoint has what was simulated, and resuming goes on from there";

struct SimulationResult {
  SignalMatrix matrix;
  SimulationSummary summary;
};

/// Estimates the signal matrix (2.14) of a scene; emitting surfaces are columns after the transceivers. The
/// result depends on the scene and the options alone (not those of the checkpoint), unless time ends it: it
/// is the same bit for bit with any number of threads, and after interruption and resumption.
///
/// The checkpoint stays: delete it when the result is saved, and where that fails say `checkpoint_remains`.
///
/// Throws InputError where the options do not fit the scene (random walks never meet a point), the matrix
/// does not fit into the memory, or the checkpoint is of another simulation, and Interrupted when cancelled
/// before everything has two batches: nothing can be said yet.
SimulationResult simulate(const Scene& scene, const SimulationOptions& options,
                          const RunControl& control = {});

/// The same straight into a signal file, without the matrix in memory; removes the checkpoint when the
/// simulation is complete.
SimulationSummary simulate_to_file(const Scene& scene, const SimulationOptions& options,
                                   const std::filesystem::path& output, const RunControl& control = {});

}  // namespace shelfbeam
