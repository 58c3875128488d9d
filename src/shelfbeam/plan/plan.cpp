#include "shelfbeam/plan/plan.hpp"

#include "shelfbeam/signal/signal_table.hpp"

namespace shelfbeam {

Plan make_plan(const Scene& scene, const std::string& store_hash, const PlanOptions& options,
               const RunControl& control) {
  Plan plan;
  plan.simulation = simulate(scene, store_hash, options.simulation, control);
  plan.placement = place(make_signal_table(plan.simulation.matrix), options.question, options.place, control);
  return plan;
}

}  // namespace shelfbeam
