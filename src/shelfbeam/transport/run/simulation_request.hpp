#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// A simulation as a user asks for it: values that are not given follow from the others.
struct SimulationRequest {
  std::optional<EstimatorKind> estimator;  ///< default: uniform if a value below requires it, else reuse
  std::optional<DirectLight> direct;       ///< of the uniform estimator
  DirectLight default_direct = DirectLight::exact;
  std::optional<std::uint64_t> samples;
  std::optional<double> relative_error, time_s;
  std::optional<double> above;               ///< of RelativeError; requires relative_error
  std::optional<std::uint64_t> max_samples;  ///< of RelativeError; requires relative_error
  std::optional<Strategy> strategy;
  std::optional<Heuristic> heuristic;
  std::optional<std::uint32_t> max_bounces;
  bool by_bounce = false;
  std::optional<double> by_length;  ///< m per layer
  std::optional<std::uint32_t> lengths;
  std::size_t memory = 0;  ///< bytes; 0: memory_limit()

  static constexpr double default_above = 0.3;
  static constexpr std::uint32_t default_lengths = 64, max_lengths = 10000;

  /// Throws InputError, with the setting, for a value that has no effect.
  EstimatorKind kind() const;
  /// Throws as `kind`, and for layers whose step or number is out of range.
  SimulationOptions options(std::uint64_t seed, CheckpointOptions checkpoint = {}) const;
};

}  // namespace shelfbeam
