#pragma once

#include <cstdint>
#include <filesystem>

#include <CLI/CLI.hpp>

#include "shelfbeam/transport/run/simulate.hpp"
#include "shelfbeam/transport/run/simulation_request.hpp"

namespace shelfbeam::app {

/// A simulation with its checkpoint, for `simulate` and `verify`.
struct SimulationFlags : SimulationRequest {
  CheckpointOptions checkpoint;

  /// The checkpoint is written beside `output`.
  SimulationOptions options(std::uint64_t seed, const std::filesystem::path& output) const;
};

void add_simulation_options(CLI::App& verb, SimulationRequest& request, DirectLight default_direct);

/// --memory, --resume and --checkpoint-interval.
void add_run_options(CLI::App& verb, SimulationRequest& request, CheckpointOptions& checkpoint);

/// --part, for `simulate`.
void add_part(CLI::App& verb, Share& part);

/// --by-bounce and --by-length, for verbs that write a signal file.
void add_layers(CLI::App& verb, SimulationRequest& request);

}  // namespace shelfbeam::app
