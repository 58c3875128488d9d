#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// To add an estimator: a value and a name here, a case in make_estimator.cpp.
enum class EstimatorKind {
  uniform,  ///< the paper's, with its strategies
  reuse     ///< path reuse (docs/methods/reuse.md); strategy, heuristic, bounces and layers do not apply
};
template <>
inline constexpr auto names_of<EstimatorKind> = std::to_array<Named<EstimatorKind>>(
    {{"reuse", EstimatorKind::reuse}, {"uniform", EstimatorKind::uniform}});

enum class DirectLight {
  sampled,  ///< by the paths' first connection, as in the paper
  exact     ///< apart: between points in closed form, once; else by stratified samples in every batch
};
template <>
inline constexpr auto names_of<DirectLight> =
    std::to_array<Named<DirectLight>>({{"sampled", DirectLight::sampled}, {"exact", DirectLight::exact}});

/// When a simulation is precise enough: 99 % of the entries that matter have this relative standard error,
/// and one that can be trusted.
struct RelativeError {
  double error = 0.05;
  double above = 0.3;  ///< entries matter whose mean exceeds this share of their label's requirement
  /// First rays per label. A label all of whose entries are precise or would need more stops after
  /// `judged_batches`, and the simulation where more than 1 % of all entries would need more.
  std::uint64_t most_samples = 1'000'000;
};

/// Fewer batches say too little about their spread to stop by it.
inline constexpr std::uint32_t least_batches = 16;

/// Where a simulation keeps what it has while it works (docs/formats/checkpoint.md).
struct CheckpointOptions {
  std::filesystem::path path = {};  ///< empty: nothing is kept
  bool resume = false;              ///< begin with what the file has, if there is one
  /// Least time between two checkpoints; they also take no more than some 5 % of the time. 0: one after every
  /// batch, whatever it takes.
  double interval_s = 10;
};

/// With a given number of samples the uniform estimator deals them out evenly over so many batches.
inline constexpr std::uint32_t batch_count = 32;

/// Its batches where the number of them is open.
inline constexpr std::uint64_t open_samples_per_batch = 64;

struct SimulationOptions {
  EstimatorKind estimator = EstimatorKind::reuse;
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
  /// Something that only the uniform estimator has is asked for.
  bool needs_uniform() const {
    return strategy != Strategy::mis || heuristic != Heuristic::balance ||
           max_bounces != PathRules::no_limit || layers() > 0;
  }
  bool has_fixed_samples() const { return !relative_error && !time_s; }
  /// First rays a label and batch of the uniform estimator: `samples` rounded up to a whole number a batch.
  std::uint64_t uniform_samples_per_batch() const {
    if (!has_fixed_samples()) return open_samples_per_batch;
    return std::max<std::uint64_t>(1, (samples + batch_count - 1) / batch_count);
  }
};

}  // namespace shelfbeam
