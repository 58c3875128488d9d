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

/// The options of `simulate`, which `plan` and `verify` also have.
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
  std::size_t memory = 0;  ///< bytes; 0: memory_limit()
  bool resume = false;
  double checkpoint_interval_s = 10;

  EstimatorKind kind() const;
  /// The checkpoint is written beside `output`.
  SimulationOptions options(std::uint64_t seed, const std::filesystem::path& output) const;
};

void add_simulation_options(CLI::App& verb, SimulationFlags& flags, DirectLight default_direct);

/// --memory, --resume and --checkpoint-interval.
void add_run_options(CLI::App& verb, SimulationFlags& flags);

/// --part, for `simulate`.
void add_part(CLI::App& verb, Share& part);

/// --by-bounce and --by-length, for verbs that write a signal file.
void add_layers(CLI::App& verb, SimulationFlags& flags);

/// A few lines: size, effort and errors of the simulation. If a certificate decides where more samples are
/// taken, they say so instead of predicting the time for smaller errors.
std::string describe(const SimulationSummary& summary, bool follows_decision = false);
nlohmann::ordered_json to_json(const SimulationSummary& summary);

}  // namespace shelfbeam::app
