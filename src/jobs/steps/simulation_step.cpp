#include "jobs/steps/simulation_step.hpp"

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

#include "shelfbeam/plan/states/reflectance_ends.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

#include "jobs/plan_job.hpp"

namespace shelfbeam::jobs {

std::unique_ptr<OutputLock> reserve_output(const std::filesystem::path& output,
                                           const std::filesystem::path& store, const Scene& scene,
                                           const SimulationOptions& options) {
  protect_input(output, store);
  expect_writable(output);
  expect_room_for_matrix(output.has_parent_path() ? output.parent_path() : ".", scene, options);
  return std::make_unique<OutputLock>(output, output.string());
}

Store store_in_state(const Store& store, const Scene& nominal, std::uint64_t seed, std::uint64_t k) {
  const Store state = StoreStates(store, nominal, seed).state(k);
  const std::string text = resolved_store_json(state, make_scene(state));
  const std::filesystem::path folder = std::filesystem::path(store.file).parent_path();
  return parse_store(text, state.file, folder, {.cancel = state.cancel});
}

StoredSignals simulate_wanted(const Store& store, const Scene& scene, const SimulationOptions& options,
                              const WantedStates& wanted, ResultLog& log, const RunControl& control) {
  const StateRange range{.first = 0, .count = wanted.states};
  if (!wanted.for_plan)
    return simulate_states(store, scene, options, range, wanted.hard_labels, log, control);
  return simulate_planning_states(with_reflectances_for_states(store, store),
                                  with_reflectances_for_states(store, scene), options, range, log, control);
}

nlohmann::ordered_json to_json(const SimulationSummary& summary) {
  nlohmann::ordered_json errors = nlohmann::ordered_json::array();
  for (const ErrorQuantiles& e : summary.errors)
    errors.push_back({{"above", e.above},
                      {"entries", e.entries},
                      {"flagged", e.flagged},
                      {"median", e.median},
                      {"p90", e.p90},
                      {"p99", e.p99}});
  nlohmann::ordered_json unmet;
  if (summary.unmet_error) {
    unmet = {{"error", *summary.unmet_error},
             {"entries", summary.unmet},
             {"out_of_reach", summary.out_of_reach},
             {"worst", nlohmann::ordered_json::array()}};
    for (const UnmetEntry& entry : summary.worst_unmet)
      unmet["worst"].push_back({{"label", entry.label},
                                {"transceiver", entry.source},
                                {"relative_error", entry.relative_error},
                                {"flagged", entry.is_flagged},
                                {"out_of_reach", entry.is_out_of_reach}});
  }
  nlohmann::ordered_json asked;
  if (summary.requested_samples) asked = *summary.requested_samples;
  return {{"labels", summary.labels},
          {"transceivers", summary.candidates},
          {"complete", summary.complete},
          {"samples", {summary.min_samples, summary.max_samples}},
          {"asked", asked},
          {"batches", {summary.min_batches, summary.max_batches}},
          {"resumed_batches", summary.resumed_batches},
          {"rays", summary.rays},
          {"shadow_rays",
           {{"connections", summary.shadow_rays.connections},
            {"traced", summary.shadow_rays.traced},
            {"occluded", summary.shadow_rays.occluded}}},
          {"seconds", summary.seconds},
          {"rays_per_second", static_cast<double>(summary.rays) / summary.seconds},
          {"relative_errors", errors},
          {"unmet", unmet},
          {"seconds_to_halve_the_errors", summary.seconds_to_halve}};
}

}  // namespace shelfbeam::jobs
