#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "shelfbeam/transport/run/stopping.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// To add an estimator: a name here, a case in make_estimator.cpp, a name in the command line's options.
enum class EstimatorKind {
  uniform,  ///< the paper's, with its strategies
  reuse     ///< path reuse (docs/methods/reuse.md); strategy, heuristic and bounces do not apply
};

enum class DirectLight {
  sampled,  ///< by the paths' first connection, as in the paper
  exact     ///< apart: between points in closed form, once; else by stratified samples in every batch
};

/// Where a simulation keeps what it has while it works (docs/formats/checkpoint.md).
struct CheckpointOptions {
  std::filesystem::path path = {};  ///< empty: nothing is kept
  bool resume = false;              ///< begin with what the file has, if there is one
  /// Least time between two checkpoints; they also take no more than some 5 % of the time. 0: one after every
  /// batch, whatever it takes.
  double interval_s = 10;
};

struct SimulationOptions {
  /// First rays a label; particles a transceiver. The simulation ends with these, unless one of the next two
  /// says otherwise.
  std::uint64_t samples = 10000;
  DirectLight direct = DirectLight::sampled;
  std::uint64_t seed = 1;
  Strategy strategy = Strategy::mis;
  Heuristic heuristic = Heuristic::balance;
  std::uint32_t max_bounces = PathRules::no_limit;
  bool by_bounce = false;  ///< fill SignalMatrix::by_bounce; needs max_bounces
  /// Fill SignalMatrix::by_length; needs walks that sample direct light, too.
  LengthSteps by_length = {};

  EstimatorKind estimator = EstimatorKind::uniform;
  std::optional<RelativeError> relative_error = {};  ///< ends when this is reached
  std::optional<double> time_s = {};  ///< ends before this is over, but not before `least_batches`
  std::size_t memory = 0;             ///< bytes that may be used; 0: any number
  CheckpointOptions checkpoint = {};

  PathRules rules() const {
    if (estimator == EstimatorKind::reuse) return {.strategy = Strategy::nee, .samples_direct = false};
    return {strategy, heuristic, max_bounces, direct == DirectLight::sampled};
  }
  std::size_t bounce_layers() const { return by_bounce ? std::size_t{max_bounces} + 1 : 0; }
  std::size_t length_layers() const { return by_length.count; }
  std::size_t layers() const { return bounce_layers() + length_layers(); }
  bool has_fixed_samples() const { return !relative_error && !time_s; }
};

}  // namespace shelfbeam
