#include "shelfbeam/plan/states/verify_states.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/scenarios/scenario_search.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"
#include "shelfbeam/plan/question/question_key.hpp"
#include "shelfbeam/plan/states/assumed_variation.hpp"
#include "shelfbeam/plan/states/causes_alone.hpp"
#include "shelfbeam/plan/states/deciding_labels.hpp"
#include "shelfbeam/plan/states/fresh_states.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/states/reflectance_ends.hpp"
#include "shelfbeam/plan/states/risk_causes.hpp"
#include "shelfbeam/plan/states/state_examination.hpp"
#include "shelfbeam/plan/states/state_sample.hpp"
#include "shelfbeam/plan/sub_scene.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t max_sample = 100;  ///< states for the choice of an addition

// The mounted units, then the candidates at other places.
Scene with_candidates(const Scene& units, const Scene& scene) {
  Scene all = units;
  for (Transceiver& unit : all.transceivers) unit.installed = true;
  for (const Transceiver& candidate : scene.transceivers) {
    const bool is_taken =
        std::any_of(units.transceivers.begin(), units.transceivers.end(), [&](const Transceiver& unit) {
          return unit.id == candidate.id || length(unit.position - candidate.position) <= position_tolerance;
        });
    if (is_taken) continue;
    all.transceivers.push_back(candidate);
    all.transceivers.back().installed = false;
  }
  return all;
}

std::optional<Addition> best_addition(const StoreStates& states, const Scene& all, std::size_t mounted,
                                      const PlacementProblem& problem, const Availability& found,
                                      const VerifyStatesOptions& options, ResultLog& log,
                                      const RunControl& control) {
  if (all.transceivers.size() == mounted) return {};
  const std::uint32_t count = std::min(options.states, max_sample);
  const SignalTable table = table_without_signals(all);
  const StateSample sample(states, all, options.simulation, {.count = count}, log, control);
  const Selection selected = all_numbers<ColumnId>(mounted);
  DecidingLabels deciding(sample, table, problem, selected);
  deciding.add_if([&](LabelId i) { return found.answer().missed[i] > 0; });
  const MissAllowance allowance = allowance_of(found.goal, found.required, deciding.labels(), count);
  const ScenarioSearch search(deciding.table(), problem, allowance, {}, control);
  const Selection more = search.with_another(selected);
  if (more.size() == selected.size()) return {};
  const Transceiver& unit = all.transceivers[more.back()];
  return Addition{unit.id, unit.position, outcome_of(deciding.misses_of_start(), mounted, count),
                  outcome_of(deciding.misses(more), more.size(), count)};
}

}  // namespace

Availability verify_over_states(const Store& store, const Scene& scene, const Scene& units,
                                const PlacementProblem& problem, const VerifyStatesOptions& options,
                                ResultLog& log, const RunControl& control) {
  const Store low_store = with_reflectances_for_states(store, store);
  const Scene low_units = with_reflectances_for_states(store, units);
  const Scene all = with_candidates(low_units, scene);
  const StoreStates states(low_store, all, options.simulation.seed);
  Availability found;
  found.goal = options.goal;
  found.confidence = options.confidence;
  found.required = required_availabilities(units, options.goal);
  found.without = causes_left_out(store);
  {
    const StateExamination examination(states, low_units, problem, options.simulation, log, control);
    const std::uint64_t question =
        question_key(question_key(options.simulation.seed, low_units, problem),
                     {scene, options.goal, found.required, options.confidence, options.states});
    const FreshStatesOptions one_look{.question = question,
                                      .round = verifying_round,
                                      .level = 1 - options.confidence,
                                      .looks = {options.states},
                                      .ends_early = false};
    FreshStates fresh = examine([&](std::uint64_t k) { return examination.missed(k); }, options.goal,
                                found.required, one_look, Deadline(HUGE_VAL), control);
    if (fresh.out_of_time) throw Interrupted("the verification was stopped");
    fresh.outcome.units = units.transceivers.size();
    found.examined.push_back(std::move(fresh.outcome));
    found.shown = std::move(fresh.shown);
    found.certified = fresh.certified;
    found.responsible = std::move(fresh.undecided);
  }
  found.at_risk =
      risk_causes(states, low_units, most_missed(found.answer()), problem, options.simulation, log, control);
  const SignalTable mounted = table_without_signals(units);
  const Selection every = all_numbers<ColumnId>(units.transceivers.size());
  const CausesAlone causes(store, units, mounted, problem, found, options.simulation, options.states, log,
                           control);
  causes.examine(every, {}, found);
  found.lost = causes.lost(always_missed(found.answer()), every);
  if (!found.certified)
    found.addition =
        best_addition(states, all, units.transceivers.size(), problem, found, options, log, control);
  log.flush();
  return found;
}

}  // namespace shelfbeam
