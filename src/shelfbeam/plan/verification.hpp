#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// How much is simulated, and with which random numbers.
struct VerificationEffort {
  /// Estimator, memory and seed, which is not that of the matrix which the placement was chosen on; the
  /// stopping rule plays no part.
  SimulationOptions simulation;
  std::uint32_t batches = 64;
};

/// The fewest batches of which limits are made.
inline constexpr std::uint32_t least_verifying_batches = 64;

/// Whether the transceivers of a scene (all of them are mounted) reach its labels, decided on fresh samples.
/// `level` is the chance that any of the verdicts `reached` and `missed` is wrong, shared by the labels after
/// Bonferroni. A label is only ever one of reached and missed in truth, so one-sided limits suffice.
///
/// Non-cooperative: `planned` has the signals that a placement was chosen on, m x n row by row; the strongest
/// of a row is the link that must do (the two strongest where a unit may fail). `missed` takes all links.
/// Throws as `sample_batches`.
std::vector<LabelVerdict> verify(const Scene& scene, const Question& question, std::span<const float> planned,
                                 double level, const VerificationEffort& effort,
                                 const RunControl& control = {});

}  // namespace shelfbeam
