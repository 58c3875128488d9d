#pragma once

#include <string>

#include "shelfbeam/placement/placement.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/simulate.hpp"

namespace shelfbeam {

struct PlanOptions {
  SimulationOptions simulation;
  Question question;
  PlaceOptions place;
};

struct Plan {
  SimulationResult simulation;
  Placement placement;
};

/// Simulates a scene and places transceivers on the matrix that comes out. A simulation that is interrupted
/// is placed with what it has.
Plan make_plan(const Scene& scene, const std::string& store_hash, const PlanOptions& options,
               const RunControl& control = {});

}  // namespace shelfbeam
