#include "shelfbeam/plan/plan.hpp"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/random.hpp"
#include "shelfbeam/placement/coverage/coverage_curve.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/plan/sensitivity.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"

namespace shelfbeam {

namespace {

constexpr double share_of_first_placement = 0.25;

// nullopt if interrupted: earlier results stay.
std::optional<Sensitivity> sensitivity_of(const Scene& scene, const Plan& plan,
                                          const SensitivityOptions& options, const SimulationOptions& fresh,
                                          const RunControl& control) {
  const SignalMatrix& matrix = plan.simulation.matrix;
  std::vector<std::uint32_t> labels(matrix.rows());
  std::iota(labels.begin(), labels.end(), 0U);
  std::vector<float> planned;
  for (const std::uint32_t i : labels)
    for (const std::uint32_t j : plan.placement.selected) planned.push_back(matrix.mean[matrix.at(i, j)]);
  VerificationEffort effort{fresh, min_verifying_batches};
  effort.simulation.samples = std::max(fresh.samples, Rounds::min_samples * batch_count);
  effort.simulation.relative_error.reset();
  effort.simulation.time_s.reset();
  effort.simulation.seed = mix_key(fresh.seed ^ 0x73656e7369746976, 0);
  try {
    return reflectance_sensitivity(sub_scene(scene, labels, plan.placement.selected), plan.placement.problem,
                                   planned, options, effort, control);
  } catch (const Interrupted&) {
    return std::nullopt;
  }
}

}  // namespace

Plan make_plan(const Scene& scene, const PlanOptions& options, const RunControl& control) {
  Plan plan;
  const auto prepared = prepare(scene, options.simulation, true, control);
  plan.simulation = simulate(*prepared, options.simulation, control);
  const TableRule table =
      options.table ? options.table : [](const SignalMatrix& matrix) { return make_signal_table(matrix); };
  // A certificate may place again, on signals that are more accurate where they decide.
  PlaceOptions first = options.place;
  if (options.confidence) first.time_limit_s *= share_of_first_placement;
  plan.placement = place(table(plan.simulation.matrix), options.problem, first, control);
  // Independent samples of few units are traced from the labels.
  SimulationOptions fresh = options.simulation;
  if (fresh.strategy == Strategy::particle) fresh.strategy = Strategy::mis;
  const bool says_something = plan.placement.has_selection() || !plan.placement.unreachable.empty();
  if (options.confidence && plan.simulation.summary.complete && says_something) {
    const CertifyOptions how{*options.confidence, options.budget, fresh, options.place};
    const bool has_rows = options.simulation.strategy != Strategy::particle;
    Certified certified = has_rows ? certify(*prepared, table, how, std::move(plan.simulation.matrix),
                                             std::move(plan.placement), control)
                                   : certify(scene, table, how, std::move(plan.simulation.matrix),
                                             std::move(plan.placement), control);
    plan.simulation.matrix = std::move(certified.matrix);
    plan.placement = std::move(certified.placement);
    plan.certificate = std::move(certified.certificate);
  }
  if (options.curve && plan.placement.has_selection())
    plan.curve = add_curve(plan.placement, table(plan.simulation.matrix), options.place.time_limit_s, control,
                           plan.certificate.has_value());
  if (options.sensitivity && plan.simulation.summary.complete && plan.placement.has_selection())
    plan.sensitivity = sensitivity_of(scene, plan, *options.sensitivity, fresh, control);
  plan.complete = plan.simulation.summary.complete && !control.cancelled();
  return plan;
}

}  // namespace shelfbeam
