#pragma once

#include <cstdint>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

struct VerifyStatesOptions {
  std::uint32_t states = 1000;
  AvailabilityGoal goal = {};
  double confidence = 0.99;
  SimulationOptions simulation = {};  ///< memory limit and seed; samples do not apply
};

/// Examines mounted units in fresh states of the shop, as plan_states.hpp examines its plans, with the whole
/// level for one look after all states. If the goal is not confirmed, simulates the candidates
/// of the store at the labels that are missed, and names the one that helps most.
///
/// `scene` is that of the store; `units` the same with the mounted units instead of the candidates. Throws
/// Interrupted when cancelled; `log` then has all finished states.
Availability verify_over_states(const Store& store, const Scene& scene, const Scene& units,
                                const PlacementProblem& problem, const VerifyStatesOptions& options,
                                ResultLog& log, const RunControl& control = {});

}  // namespace shelfbeam
