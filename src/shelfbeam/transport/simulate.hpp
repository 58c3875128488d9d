#pragma once

#include <cstdint>
#include <string>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

enum class DirectLight {
  sampled,  ///< by the walk's first connection, as in the paper
  exact     ///< in closed form, once
};

struct SimulationOptions {
  std::uint64_t samples = 10000;  ///< first rays a label
  DirectLight direct = DirectLight::sampled;
  std::uint64_t seed = 1;
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

/// Estimates the signal matrix (2.14) of a scene. The result depends on scene, samples, direct and seed
/// alone: it is the same bit for bit with any number of threads. Cancelled before every label has two batches
/// it throws Interrupted: nothing can be said yet.
SimulationResult simulate(const Scene& scene, const std::string& store_hash, const SimulationOptions& options,
                          const RunControl& control = {});

}  // namespace shelfbeam
