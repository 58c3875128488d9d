#include "shelfbeam/plan/plan.hpp"

#include "shelfbeam/signal/signal_table.hpp"

namespace shelfbeam {

Plan make_plan(const Scene& scene, const std::string& store_hash, const PlanOptions& options,
               const RunControl& control) {
  Plan plan;
  plan.simulation = simulate(scene, store_hash, options.simulation, control);
  const TableRule table =
      options.table ? options.table : [](const SignalMatrix& matrix) { return make_signal_table(matrix); };
  plan.placement = place(table(plan.simulation.matrix), options.question, options.place, control);
  // Fresh samples of few units come from the labels.
  SimulationOptions fresh = options.simulation;
  if (fresh.strategy == Strategy::particle) fresh.strategy = Strategy::mis;
  const bool says_something = plan.placement.has_selection() || !plan.placement.unreachable.empty();
  if (options.confidence && plan.simulation.summary.complete && says_something)
    plan.placement.certificate =
        certify(scene, table, {*options.confidence, options.budget_s, fresh, options.place},
                plan.simulation.matrix, plan.placement, control);
  plan.complete = plan.simulation.summary.complete && !control.cancelled();
  return plan;
}

}  // namespace shelfbeam
