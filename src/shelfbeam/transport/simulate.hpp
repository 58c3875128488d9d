#pragma once

#include <cstdint>
#include <string>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"
#include "shelfbeam/transport/path_rules.hpp"

namespace shelfbeam {

enum class DirectLight {
  sampled,  ///< by the paths' first connection, as in the paper
  exact     ///< apart: between points in closed form, once; else by stratified samples in every batch
};

struct SimulationOptions {
  std::uint64_t samples = 10000;  ///< first rays a label; particles a transceiver
  DirectLight direct = DirectLight::sampled;
  std::uint64_t seed = 1;
  Strategy strategy = Strategy::mis;
  Heuristic heuristic = Heuristic::balance;
  std::uint32_t max_bounces = PathRules::no_limit;
  bool by_bounce = false;  ///< fill SignalMatrix::by_bounce; needs max_bounces
};

/// Standard errors come from this many independent batches; the samples are dealt out evenly.
inline constexpr std::uint32_t batch_count = 32;

/// First rays a label and batch: `samples` rounded up to a whole number a batch.
std::uint64_t samples_per_batch(std::uint64_t samples);

struct SimulationResult {
  SignalMatrix matrix;
  bool complete = true;  ///< false: cancelled; the rows say how many batches each label got
  std::uint64_t rays = 0;
  double seconds = 0;
};

/// Estimates the signal matrix (2.14) of a scene; emitting surfaces are columns after the transceivers. The
/// result depends on the scene and the options alone: it is the same bit for bit with any number of threads.
///
/// Throws InputError where the options do not fit the scene (random walks never meet a point), and
/// Interrupted when cancelled before everything has two batches: nothing can be said yet.
SimulationResult simulate(const Scene& scene, const std::string& store_hash, const SimulationOptions& options,
                          const RunControl& control = {});

}  // namespace shelfbeam
