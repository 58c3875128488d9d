#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/certificate.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/sample_batches.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

/// Effort and random numbers of a simulation.
struct VerificationEffort {
  /// Estimator, memory limit and seed, which must differ from that of the planning matrix. The stopping rule
  /// does not apply.
  SimulationOptions simulation;
  std::uint32_t batches = 64;
};

/// Minimum number of batches for confidence limits.
inline constexpr std::uint32_t min_verifying_batches = 64;

/// The levels of the two statements on labels.
struct VerdictLevels {
  /// The probability that any verdict `reached` or `missed` is wrong, shared by all labels of the statement
  /// (Bonferroni). One-sided limits suffice, because a label is in truth either reached or missed.
  double list = 0;
  std::size_t labels = 0;
  /// The level of every lower limit for the joint statement that all labels are reached. If it is false, some
  /// label is missed, which one does not depend on the samples, and the statement requires the limit of this
  /// label, among others, to meet its requirement (intersection-union test; Berger 1982). So no share is
  /// lost.
  double joint = 0;
};

/// Verifies with independent samples whether the transceivers of a scene (all mounted) reach some of its
/// labels.
///
/// Non-cooperative: `planned` contains the signals of the planning matrix, m x n row by row; the strongest
/// link of a row must meet the requirement (with unit failure, the two strongest). `missed` tests all links.
/// Throws as `sample_batches`.
std::vector<LabelVerdict> verify(const PreparedScene& prepared, const BatchRequest& request,
                                 const PlacementProblem& problem, std::span<const float> planned,
                                 const VerdictLevels& levels, const RunControl& control = {});

/// All labels of a scene that is prepared for this purpose, as a list at `level`.
std::vector<LabelVerdict> verify(const Scene& scene, const PlacementProblem& problem,
                                 std::span<const float> planned, double level,
                                 const VerificationEffort& effort, const RunControl& control = {});

}  // namespace shelfbeam
