#pragma once

#include <cstdint>
#include <functional>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/checkpoint/result_log.hpp"
#include "shelfbeam/signal/parts/sampled_states.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/simulation_options.hpp"

namespace shelfbeam {

struct StatesOptions {
  std::uint32_t sample = 100;              ///< states on which units are placed
  const SampledStates* sampled = nullptr;  ///< these states, if they are simulated already
  AvailabilityGoal goal = {};
  double confidence = 0.99;
  bool certifies = true;              ///< examine plans in fresh states
  double budget_s = 600;              ///< of the examinations
  SimulationOptions simulation = {};  ///< memory limit and seed; samples do not apply
  PlaceOptions place = {};            ///< the time limit is that of each placement over states
};

/// Places transceivers for a shop that changes, and certifies the placement (docs/methods/changing_shop.md):
///
/// 1. Simulates `sample` states and finds the smallest selection that keeps to the goal on these
///    (place_over_scenarios.hpp), and a bound. With allowances widened so that any selection which keeps to
///    the goal in the long run fits them, and signals raised to their upper limits, the bound holds beyond
///    the sample.
/// 2. Names a plan, then draws fresh states and examines it in them (state_examination.hpp). If it cannot be
///    certified, the plan of the next round has one unit more, and new states. The levels of all rounds and
///    looks sum to (1 - confidence) / 2; the other half belongs to the bound.
/// 3. Finds the causes at the labels that are missed most often.
///
/// Reflectances are at the low ends of their ranges (reflectance_ends.hpp). `scene` is that of the store,
/// `table` the table of its labels and candidates with all constraints (its signals are not used), `nominal`
/// the placement for the shop as the file gives it; its problem applies. The result's selection is the last
/// examined plan; without one, that of the sample; without this, `nominal`. Interrupted, it ends with its
/// results so far, and `log` has all finished states.
struct PlanOverStates {
  Placement placement;
  Availability availability;
};
PlanOverStates plan_over_states(const Store& store, const Scene& scene, const SignalTable& table,
                                const Placement& nominal, const StatesOptions& options, ResultLog& log,
                                const RunControl& control = {});

}  // namespace shelfbeam
