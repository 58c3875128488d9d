#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/answer/given_signals.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/plan/question/partial_question.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam {

/// Samples per label of the planning matrix if the certificate decides where more are needed: 16 batches of
/// path reuse.
inline constexpr std::uint64_t decision_samples = 2000;

struct PlanOptions {
  SimulationOptions simulation;
  /// Signals that another run has simulated. If they fit (fitting_signals), nothing is simulated for the
  /// first placement.
  std::optional<StoredSignals> signals;
  PlacementProblem problem;
  /// Instead of a selection that reaches all labels. The certificate then verifies its labels, without bound.
  PartialQuestion partial = {};
  PlaceOptions place;
  TableRule table;                          ///< empty: the matrix without constraints
  std::optional<double> confidence = 0.99;  ///< of the certificate; nullopt: no certificate
  RoundBudget budget = {};                  ///< of the certificate
  bool curve = false;                       ///< compute the coverage curve, too
  bool alternatives = false;                ///< compare with other selections, too
  std::optional<SensitivityOptions> sensitivity = {};
};

/// With its simulation, whose matrix is the final one of the placement.
struct Plan : CertifiedPlan {
  SimulationResult simulation;
  std::optional<GivenSignals> signals;  ///< if signals were given
  bool complete = false;                ///< nothing was interrupted
};

/// Simulates a scene, places transceivers on the matrix, and certifies the placement, which may refine both.
/// Nothing is certified if the search stopped without a selection. Curve and sensitivity (from independent
/// samples) refer to the final placement. Warnings are those of the scene, and one if nearly all labels
/// receive far more than they require, or less. An interrupted simulation is placed with its samples so far
/// and not certified. With the simulation's checkpoint an interrupted plan continues, to the same result as
/// an uninterrupted one, apart from decisions by time.
Plan make_plan(const Scene& scene, PlanOptions options, const RunControl& control = {});

}  // namespace shelfbeam
