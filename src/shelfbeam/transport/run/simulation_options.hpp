#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// To add an estimator, add a value and a name here and a case in make_estimator.cpp.
enum class EstimatorKind {
  uniform,  ///< the paper's estimator, with its strategies
  reuse     ///< path reuse (docs/methods/reuse.md); strategy, heuristic, bounces and layers do not apply
};
template <>
inline constexpr auto names_of<EstimatorKind> = std::to_array<Named<EstimatorKind>>(
    {{"reuse", EstimatorKind::reuse}, {"uniform", EstimatorKind::uniform}});

enum class DirectLight {
  sampled,  ///< by the first connection of paths, as in the paper
  exact     ///< separately: between points once in closed form, otherwise by stratified samples per batch
};
template <>
inline constexpr auto names_of<DirectLight> =
    std::to_array<Named<DirectLight>>({{"sampled", DirectLight::sampled}, {"exact", DirectLight::exact}});

/// A simulation is precise enough when 99 % of the entries that matter have at most this relative standard
/// error and are not flagged.
struct RelativeError {
  double error = 0.05;
  double above = 0.3;  ///< entries matter if their mean exceeds this share of their label's requirement
  /// Max number of first rays per label. From `judged_batches` on, an item stops if each of its entries is
  /// precise enough or would need more rays, and the simulation ends if more than 1 % of all entries would.
  std::uint64_t max_samples = 1'000'000;
};

/// Minimum number of batches for a stop by errors; the spread of fewer batches is too uncertain.
inline constexpr std::uint32_t min_batches = 16;

/// Where and how often a running simulation saves its state (docs/formats/checkpoint.md).
struct CheckpointOptions {
  std::filesystem::path path = {};  ///< empty: no checkpoint
  bool resume = false;              ///< continue from the file if it exists
  /// Minimum time between two checkpoints, which also take at most about 5 % of the run time. 0: a checkpoint
  /// after every round of batches, regardless of its duration.
  double interval_s = 10;
  bool at_end = false;  ///< try to save the complete simulation, too: later steps may be interrupted
};

/// A part of a simulation: `number` of `count`, from 1.
struct Share {
  std::uint32_t number = 1, count = 1;
  bool is_whole() const { return count == 1; }
};

/// Number of batches over which the uniform estimator distributes a given number of samples evenly.
inline constexpr std::uint32_t batch_count = 32;

/// Samples per batch of the uniform estimator if the number of batches is not fixed.
inline constexpr std::uint64_t open_samples_per_batch = 64;

struct SimulationOptions {
  EstimatorKind estimator = EstimatorKind::reuse;
  /// First rays per label (for particles, per source). Ignored with `relative_error` or `time_s`.
  std::uint64_t samples = 10000;
  DirectLight direct = DirectLight::sampled;
  std::uint64_t seed = 1;
  Strategy strategy = Strategy::mis;
  Heuristic heuristic = Heuristic::balance;
  std::uint32_t max_bounces = PathRules::no_limit;
  bool by_bounce = false;  ///< fill SignalMatrix::by_bounce; requires max_bounces
  /// Fill SignalMatrix::by_length; requires walks that also sample direct light.
  LengthSteps by_length = {};

  /// For path reuse: paths continue everywhere as at a surface of this albedo, or a brighter one. Runs of one
  /// seed that differ in reflectances up to this one take the same paths, so their differences are precise.
  double brightest = 0;

  std::optional<RelativeError> relative_error = {};  ///< stop when the matrix is precise enough
  std::optional<double> time_s = {};                 ///< time limit; at least `min_batches` are computed
  std::size_t memory = 0;                            ///< memory limit, bytes; 0: none
  CheckpointOptions checkpoint = {};
  /// Simulate only some labels; requires `has_fixed_samples` and walks from labels. `merge_parts` joins all
  /// parts to the bytes of the whole simulation.
  Share part = {};

  PathRules rules() const {
    if (estimator == EstimatorKind::reuse) return {.strategy = Strategy::nee, .samples_direct = false};
    return {strategy, heuristic, max_bounces, direct == DirectLight::sampled};
  }
  std::size_t bounce_layers() const { return by_bounce ? std::size_t{max_bounces} + 1 : 0; }
  std::size_t length_layers() const { return by_length.count; }
  std::size_t layers() const { return bounce_layers() + length_layers(); }
  /// Whether an option requires the uniform estimator.
  bool needs_uniform() const {
    return strategy != Strategy::mis || heuristic != Heuristic::balance ||
           max_bounces != PathRules::no_limit || layers() > 0;
  }
  bool has_fixed_samples() const { return !relative_error && !time_s; }
  /// First rays per label and batch of the uniform estimator: `samples` over `batch_count`, rounded up.
  std::uint64_t uniform_samples_per_batch() const {
    if (!has_fixed_samples()) return open_samples_per_batch;
    return std::max<std::uint64_t>(1, (samples + batch_count - 1) / batch_count);
  }
};

}  // namespace shelfbeam
