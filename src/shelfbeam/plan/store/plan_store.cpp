#include "shelfbeam/plan/store/plan_store.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/states/plan_states.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/parts/sampled_states.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

namespace shelfbeam {

namespace {

// The plan for the shop as the file gives it is only the beginning of one over states.
constexpr double share_of_nominal = 0.25;

PlanOptions nominal_options(const PlanRequest& request, const SimulationOptions& simulation, bool changes) {
  PlanOptions options;
  options.simulation = simulation;
  options.problem = request.problem;
  options.partial = request.partial;
  options.place = request.place;
  options.place.seed = request.seed;
  options.budget.seconds = request.budget_s;
  options.curve = request.curve;
  options.confidence.reset();
  if (changes) {
    options.place.time_limit_s *= share_of_nominal;
    return options;
  }
  options.alternatives = request.alternatives;
  if (request.certifies) options.confidence = request.confidence;
  if (request.reflectance_error) options.sensitivity = {*request.reflectance_error, request.confidence};
  return options;
}

void expect_fixed_shop(const PlanRequest& request, const PlanInputs& inputs) {
  expect_no_goal(request.goal);
  if (!inputs.sampled.empty())
    throw InputError("sampled states", "apply to a shop that changes only", "omit them", Setting::sampled);
}

void expect_possible_goal(const AvailabilityGoal& goal) {
  if (!goal.value) {
    if (goal.rule != AvailabilityRule::labels) throw InputError("the goal", "has no value", "give one");
    return;
  }
  const bool is_share = goal.rule != AvailabilityRule::misses;
  const double least = goal.rule == AvailabilityRule::labels ? 0.5 : is_share ? 0.01 : 0;
  const double most = is_share ? 0.9999 : HUGE_VAL;
  if (!(*goal.value >= least && *goal.value <= most && *goal.value > 0))
    throw InputError(
        "the goal", fmt::format("is {}", *goal.value),
        is_share ? fmt::format("use a share from {} to {}", least, most) : "use a positive number");
}

void expect_changing_shop(const PlanRequest& request, const Store& store) {
  expect_variation(store);
  expect_possible_goal(request.goal);
  const auto refuse = [](const char* where, const char* problem, Setting setting) {
    throw InputError(where, problem, "omit it, or plan the shop as in the store file, in 0 states", setting);
  };
  if (request.partial.is_asked())
    refuse("a part of the labels", "cannot be asked for in a shop that changes",
           request.partial.share ? Setting::share_of_labels : Setting::units);
  if (request.curve) refuse("the curve", "does not apply to a shop that changes", Setting::curve);
  if (request.reflectance_error)
    refuse("the sensitivity", "does not apply to a shop that changes: reflectances are at their low ends",
           Setting::sensitivity);
  if (request.problem.objective != Objective::count || request.problem.combination == Combination::weighted)
    refuse("the objective", "does not apply to a shop that changes: the count or the price is minimised",
           Setting::objective);
}

}  // namespace

SimulationOptions simulation_of(const PlanRequest& request, const CheckpointOptions& checkpoint) {
  SimulationOptions simulation = request.simulation.options(request.seed, checkpoint);
  simulation.checkpoint.at_end = true;
  if (request.follows_decision()) simulation.samples = decision_samples;
  return simulation;
}

std::uint32_t states_of(const PlanRequest& request, const Store& store) {
  return request.states.value_or(store.variation ? StatesOptions().sample : 0);
}

SignalTable table_of(const PlanRequest& request, const SignalMatrix& matrix, const std::string& name) {
  SignalTable table = make_signal_table(matrix);
  request.constraints.apply(table, name);
  return table;
}

void check_request(const PlanRequest& request, const PlanInputs& inputs, const Store& store,
                   const Scene& scene, const std::string& name) {
  const std::uint32_t states = states_of(request, store);
  if (states == 0)
    expect_fixed_shop(request, inputs);
  else
    expect_changing_shop(request, store);
  check_question(request.partial, request.problem);
  if (request.partial.is_asked() && request.curve)
    throw InputError("the curve", "belongs to plans that reach all labels", "omit it", Setting::curve);
  SignalTable nothing = table_without_signals(scene);
  request.constraints.apply(nothing, name);
  simulation_of(request);
  if (!inputs.sampled.empty())
    SampledStates(inputs.sampled)
        .expect(scene.store_hash, request.seed, scene.labels.size(), scene.transceivers.size(), states);
}

Plan plan_store(const Store& store, const Scene& scene, const PlanRequest& request, PlanInputs inputs,
                const RunControl& control, const std::string& name) {
  check_request(request, inputs, store, scene, name);
  return plan_checked(store, scene, request, std::move(inputs), control, name);
}

Plan plan_checked(const Store& store, const Scene& scene, const PlanRequest& request, PlanInputs inputs,
                  const RunControl& control, const std::string& name) {
  const std::uint32_t states = states_of(request, store);
  const SimulationOptions simulation = simulation_of(request, inputs.checkpoint);
  PlanOptions options = nominal_options(request, simulation, states > 0);
  options.signals = std::move(inputs.signals);
  options.table = [&](const SignalMatrix& matrix) { return table_of(request, matrix, name); };
  Plan plan = make_plan(scene, std::move(options), control);
  if (states == 0 || !plan.complete || !plan.placement.has_selection()) return plan;
  std::optional<SampledStates> sampled;
  if (!inputs.sampled.empty()) sampled.emplace(inputs.sampled);
  StatesOptions over{.sample = states,
                     .sampled = sampled ? &*sampled : nullptr,
                     .goal = request.goal,
                     .confidence = request.confidence,
                     .certifies = request.certifies,
                     .budget_s = request.budget_s,
                     .simulation = simulation,
                     .place = request.place};
  over.place.seed = request.seed;
  ResultLog log = log_of_states(inputs.states_checkpoint, scene.store_hash, simulation);
  PlanOverStates found = plan_over_states(store, scene, table_of(request, plan.simulation.matrix, name),
                                          plan.placement, over, log, control);
  plan.placement = std::move(found.placement);
  plan.availability = std::move(found.availability);
  plan.complete = !control.cancelled();
  return plan;
}

}  // namespace shelfbeam
