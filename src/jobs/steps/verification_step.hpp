#pragma once

#include <filesystem>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/plan/states/verify_states.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"

#include "jobs/exit_code.hpp"

namespace shelfbeam::jobs {

/// Units to be verified in a store.
struct Installation {
  Store store;
  Scene scene;  ///< its transceivers are the mounted units
  PlacementProblem problem;
};

/// The units of a placement.json, of a CSV, or those that the store chooses (given_units). `name`: of the
/// store in errors. Throws InputError.
Installation installation_of(Store store, const std::filesystem::path& units,
                             const std::filesystem::path& name);

/// Throws as verify_over_states.
Availability verify_in_states(const Installation& installation, const VerifyStatesOptions& options,
                              ResultLog& log, const RunControl& control);

ExitCode exit_code_of(const Certificate& certificate);
ExitCode exit_code_of(const Availability& availability);

}  // namespace shelfbeam::jobs
