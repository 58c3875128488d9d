#pragma once

#include <optional>
#include <string>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/answer/sensitivity.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam {

struct PlanOptions {
  SimulationOptions simulation;
  Question question;
  PlaceOptions place;
  TableRule table;                          ///< empty: the matrix as it is
  std::optional<double> confidence = 0.99;  ///< of the certificate; none: no certificate
  RoundBudget budget = {};                  ///< of the certificate
  bool curve = false;                       ///< tell what fewer units reach, too
  std::optional<SensitivityOptions> sensitivity = {};
};

/// With the simulation that it rests on: the matrix is the one that it was placed on in the end.
struct Plan : CertifiedPlan {
  SimulationResult simulation;
  bool complete = false;  ///< nothing was interrupted
};

/// Simulates a scene, places transceivers on the matrix that comes out, and certifies the placement, which
/// may refine both; nothing is certified where the search for a placement was stopped without one.
/// On what comes out rest the curve and, from fresh samples, the sensitivity. A simulation that is
/// interrupted is placed with what it has, and not certified. With its checkpoint an interrupted plan goes
/// on, and ends as one that was not (but for what time decides).
Plan make_plan(const Scene& scene, const PlanOptions& options, const RunControl& control = {});

}  // namespace shelfbeam
