#pragma once

#include <filesystem>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"
#include "shelfbeam/transport/run/simulation_summary.hpp"

namespace shelfbeam {

/// Advice if an output could not be written after a simulation with a checkpoint (Setting::resumption).
inline constexpr auto checkpoint_remains =
    "the checkpoint contains the simulated batches, and resuming continues from there";
/// The same if it does not contain all of them.
inline constexpr auto older_checkpoint = "resuming continues from an older checkpoint";

class PreparedScene;

struct SimulationResult {
  SignalMatrix matrix;
  SimulationSummary summary;
};

/// Estimates the signal matrix (2.14) of a scene; emitting surfaces are columns after the transceivers.
/// Without a time limit, the result depends only on the scene and the options (except `checkpoint`): it is
/// the same bit by bit for any number of threads, and after interrupting and resuming.
///
/// The checkpoint remains: delete it after saving the result; if saving fails, print `checkpoint_remains`.
///
/// Throws InputError if the options do not fit the scene (random walks never meet a point), the matrix
/// exceeds the memory limit, or the checkpoint is of another simulation. Throws Interrupted when cancelled
/// before every item has two batches, or before a part is complete.
SimulationResult simulate(const Scene& scene, const SimulationOptions& options,
                          const RunControl& control = {});

/// The same with a prepared scene. The options must be those with which it was prepared, except for the
/// stopping rule and the checkpoint.
SimulationResult simulate(const PreparedScene& prepared, const SimulationOptions& options,
                          const RunControl& control = {});

/// Writes the matrix directly to a signal file instead of keeping it in memory. Removes the checkpoint when
/// the simulation is complete.
SimulationSummary simulate_to_file(const Scene& scene, const SimulationOptions& options,
                                   const std::filesystem::path& output, const RunControl& control = {});

}  // namespace shelfbeam
