#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam::app {

/// The options of `simulate`, which `plan` takes too.
struct SimulationFlags {
  std::optional<EstimatorKind> estimator;
  std::optional<DirectLight> direct;
  DirectLight default_direct = DirectLight::sampled;
  std::optional<std::uint64_t> samples;
  std::optional<double> relative_error, time_s;
  std::optional<double> above;
  std::optional<std::uint64_t> max_samples;
  std::optional<Strategy> strategy;
  std::optional<Heuristic> heuristic;
  std::optional<std::uint32_t> max_bounces;
  bool by_bounce = false;
  std::optional<double> by_length;
  std::optional<std::uint32_t> lengths;
  std::size_t memory = 0;  ///< bytes; 0: most of what the machine has
  bool resume = false;
  double checkpoint_interval_s = 10;

  EstimatorKind kind() const;
  /// `output` is what the checkpoint lies beside.
  SimulationOptions options(std::uint64_t seed, const std::filesystem::path& output) const;
};

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, DirectLight default_direct);

/// --by-bounce and --by-length, which only a verb that leaves a signal file has.
void add_layers(CLI::App& verb, SimulationFlags& flags);

/// Some lines about what was simulated and how good it is.
std::string describe(const SimulationSummary& summary);
nlohmann::ordered_json to_json(const SimulationSummary& summary);

}  // namespace shelfbeam::app
