#include "jobs/preview/first_answer.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/plan/preview/preview_matrix.hpp"
#include "shelfbeam/plan/question/fitting_signals.hpp"
#include "shelfbeam/scene/read_scene.hpp"

#include "jobs/preview/light_job.hpp"
#include "jobs/preview/preview_job.hpp"
#include "jobs/stored_plan.hpp"

namespace shelfbeam::jobs {

namespace {

std::optional<SignalMatrix> given_matrix(const PlanJob& job, const Scene& scene, const PathRules& wanted) {
  try {
    auto signals = given_signals(job);
    if (!signals) return {};
    auto fitting = fitting_signals(std::move(*signals), scene, wanted);
    if (auto* matrix = std::get_if<SignalMatrix>(&fitting)) return std::move(*matrix);
  } catch (const InputError&) {
    // Previews answer in place of signals that cannot be read; the plan reports the error.
  }
  return {};
}

// The usual operator if it is kept, and otherwise a coarse one, which is then kept.
LightOperator operator_for(const PlanJob& job, const World& world, const RunControl& control) {
  const std::size_t labels = world.scene.labels.size();
  if (auto kept = LightOperator::load(*job.preview / operator_name, world, light_seed, usual_effort(labels)))
    return std::move(*kept);
  return kept_or_made(world, *job.preview / coarse_operator_name, coarse_operator, job.store.string(),
                      control);
}

SignalMatrix previews_of(const PlanJob& job, const Scene& scene, const RunControl& control) {
  const World world(scene);
  return preview_matrix(scene, operator_for(job, world, control), light_seed, control);
}

}  // namespace

PlanEnd run_first_answer(const PlanJob& job, const JobWatch& watch) {
  const RunControl control{job.threads, watch.cancel, watch.progress};
  const ThreadLimit allowed(control.threads);
  return with_threads(control.threads, [&] {
    const Store store = store_of(job, watch.cancel);
    const Scene scene = make_scene(store);
    const std::string name = job.store.string();
    PlanRequest request = job.plan;
    request.states = 0;
    request.curve = false;
    request.reflectance_error.reset();
    check_request(request, {}, store, scene, name);
    if (watch.read) watch.read();
    PlanEnd end;
    SignalMatrix& matrix = end.plan.simulation.matrix;
    if (auto given = given_matrix(job, scene, simulation_of(request).rules()))
      matrix = std::move(*given);
    else
      matrix = previews_of(job, scene, control);
    end.table = table_of(request, matrix, name);
    PlaceOptions place_options = request.place;
    place_options.seed = request.seed;
    place_options.time_limit_s = std::min(place_options.time_limit_s, first_answer_s);
    Placement& placement = end.plan.placement;
    placement = request.partial.is_asked()
                    ? place_partially(end.table, request.problem, request.partial, place_options, control)
                    : place(end.table, request.problem, place_options, control);
    end.plan.complete = !control.cancelled();
    end.code = end.plan.complete ? exit_code_of(placement.status) : stopped_early;
    return end;
  });
}

}  // namespace shelfbeam::jobs
