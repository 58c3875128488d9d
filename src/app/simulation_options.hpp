#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "shelfbeam/transport/simulate.hpp"

namespace shelfbeam::app {

/// The options of `simulate`, which `plan` takes too.
struct SimulationFlags {
  std::string estimator = "uniform";
  std::string direct;
  std::uint64_t samples = 10000;
  std::string strategy = "mis", heuristic = "balance";
  std::optional<std::uint32_t> max_bounces;
  bool by_bounce = false;

  SimulationOptions options(std::uint64_t seed) const;
};

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, const std::string& default_direct);

/// --by-bounce, which only a verb that leaves a signal file has.
void add_by_bounce(CLI::App& verb, SimulationFlags& flags);

/// Throws InputError naming the store file when the matrix would not fit into this machine's memory.
void expect_memory_for(const Scene& scene, const SimulationOptions& options,
                       const std::filesystem::path& store);

/// One line about what was simulated and how good it is.
std::string describe(const SimulationResult& result);

}  // namespace shelfbeam::app
