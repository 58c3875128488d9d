#pragma once

#include <filesystem>
#include <string>

#include <CLI/CLI.hpp>

#include "shelfbeam/transport/simulate.hpp"

namespace shelfbeam::app {

/// The options of `simulate`, which `plan` takes too.
struct SimulationFlags {
  std::string estimator = "uniform";
  std::string direct;
  std::uint64_t samples = 10000;

  SimulationOptions options(std::uint64_t seed) const;
};

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, const std::string& default_direct);

/// Throws InputError naming the store file when the matrix would not fit into this machine's memory.
void expect_memory_for(const Scene& scene, const std::filesystem::path& store);

/// One line about what was simulated and how good it is.
std::string describe(const SimulationResult& result);

}  // namespace shelfbeam::app
