#include "jobs/plan_job.hpp"

#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/store/given_units.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"

#include "jobs/plan_files.hpp"
#include "jobs/plan_values.hpp"
#include "jobs/run_file.hpp"
#include "jobs/stored_plan.hpp"

namespace shelfbeam::jobs {
namespace fs = std::filesystem;

namespace {

// The folder must not be that of the store file, unless a plan wrote the file: its hash is that of the store.
void expect_own_folder(const fs::path& folder, const fs::path& file, const std::string& hash) {
  std::error_code missing;
  const auto home = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::exists(file)) return;  // a store in memory
  if (fs::equivalent(folder, home, missing) && hash_of_resolved(read_file(file)) != hash)
    throw InputError(folder.string(), "is the folder of the store file; a plan needs a folder of its own",
                     "choose another folder for the plan");
}

// The report may travel; it names the files of the store without the folder.
void shorten_names(std::vector<Finding>& warnings, const fs::path& store) {
  const std::string home = (store.parent_path() / "").string();
  const auto shorten = [&](std::string& text) {
    if (text.starts_with(home)) text.erase(0, home.size());
  };
  for (Finding& warning : warnings) {
    shorten(warning.sentence);
    shorten(warning.path);
  }
}

// A requested result about the selection is incomplete.
bool is_open(const PlanRequest& request, const Plan& plan, bool is_imprecise) {
  if (const auto& availability = plan.availability)
    return !availability->is_impossible() &&
           (request.certifies ? !availability->certified : availability->sample_selected.empty());
  return is_imprecise || !plan.curve.is_complete ||
         (request.reflectance_error && plan.placement.has_selection() && !plan.sensitivity);
}

// A certified plan can be mounted, even if fewer units may suffice.
ExitCode code_of(const CertifiedPlan& plan) {
  if (!plan.certificate) return exit_code_of(plan.placement.status);
  if (plan.placement.has_selection()) return plan.certificate->all_reached() ? done : stopped_early;
  return plan.certificate->open ? stopped_early : exit_code_of(plan.placement.status);
}

// The selection need not reach all labels; for a share, the certified labels decide.
ExitCode code_of(const PartialReach& partial, const Certificate& certificate) {
  const std::size_t reached = certificate.count(Verdict::reached),
                    missed = certificate.count(Verdict::missed);
  const std::size_t labels = certificate.labels.size();
  if (partial.goal == ReachGoal::at_most) return reached + missed < labels ? stopped_early : done;
  if (partial.goal == ReachGoal::given && missed > 0) return answer_is_no;
  const double share = partial.goal == ReachGoal::share ? partial.value : 1, rounding = 1e-9;
  const double wanted = share * static_cast<double>(labels) * (1 - rounding);
  if (static_cast<double>(reached) >= wanted) return done;
  return stopped_early;  // another selection may reach it
}

ExitCode code_of(const PlanRequest& request, const Plan& plan, bool is_imprecise) {
  if (!plan.complete) return stopped_early;
  if (plan.placement.partial && plan.certificate) return code_of(*plan.placement.partial, *plan.certificate);
  if (plan.availability && plan.availability->is_impossible()) return answer_is_no;
  if (is_open(request, plan, is_imprecise)) return stopped_early;
  return plan.availability ? done : code_of(plan);
}

}  // namespace

std::optional<StoredSignals> given_signals(const PlanJob& job) {
  if (!job.signal) return {};
  try {
    return read_given_signals(*job.signal);
  } catch (const InputError&) {
    if (!job.is_signal_optional) throw;
    return {};
  }
}

Store with_choice(Store store, const PlanJob& job) {
  for (const std::string& unit : job.units.pinned) store.pinned.push_back({unit, job.store.string()});
  for (const std::string& unit : job.units.excluded) store.excluded.push_back({unit, job.store.string()});
  leave_out(store, job.without);
  return store;
}

Store store_of(const PlanJob& job, const CancelToken* cancel) {
  Store store = read_store(job.store, {.allow_outside = job.allow_outside,
                                       .memory = job.plan.simulation.memory,
                                       .file_size = job.file_size.value_or(StoreLimits{}.file_size),
                                       .cancel = cancel});
  return with_choice(std::move(store), job);
}

void expect_no_warnings(const Scene& scene, bool strict) {
  if (!strict || scene.warnings.empty()) return;
  const std::size_t others = scene.warnings.size() - 1;
  throw InputError(
      "", scene.warnings.front().sentence,
      others == 0 ? "warnings count as errors"
                  : fmt::format("there are {}; warnings count as errors", counted(others, "other warning")),
      Setting::strictness);
}

void expect_room_for_matrix(const fs::path& folder, const Scene& scene, const SimulationOptions& options,
                            std::size_t others) {
  // Matrix: three floats and a flag per entry, and two floats per layer. Checkpoint: doubles instead.
  const double each = (13 + 24) + (8 + 16) * static_cast<double>(options.layers());
  const double bytes =
      each * static_cast<double>(scene.labels.size()) * static_cast<double>(scene.transceivers.size());
  // A simulation that exceeds the memory is refused for that reason.
  if (bytes < static_cast<double>(options.memory)) expect_room(folder, bytes + static_cast<double>(others));
}

PlanEnd run_plan(const PlanJob& job, const JobWatch& watch) {
  const RunClock clock;
  return run_plan(job, store_of(job, watch.cancel), watch, clock);
}

PlanEnd run_plan(const PlanJob& job, Store store, const JobWatch& watch, const RunClock& clock) {
  PlanRequest request = job.plan;
  if (job.selection) store = with_candidates_of(*job.selection, std::move(store));
  const Scene scene = make_inspected_scene(store);
  if (job.selection) {
    const Placement given = given_units(*job.selection, scene, job.store);
    request.partial.given = given.selected;
    request.problem.model = job.model.value_or(given.problem.model);
    request.problem.redundant = request.problem.redundant || given.problem.redundant;
    request.states = 0;
  }
  if (states_of(request, store) == 0) expect_no_goal({}, job.without);
  const std::string resolved = resolved_store_json(store, scene);
  expect_own_folder(job.folder, job.store, scene.store_hash);
  PlanInputs inputs{.sampled = job.sampled,
                    .checkpoint = job.checkpoint,
                    .states_checkpoint = job.folder / states_checkpoint_name};
  inputs.checkpoint.path = checkpoint_path(job.folder / signal_name);
  const std::string name = job.store.string();
  check_request(request, inputs, store, scene, name);
  if (watch.read) watch.read();
  const SimulationOptions simulation = simulation_of(request, inputs.checkpoint);
  const auto can_reuse = [&] {
    return !job.signal && has_fitting_signals(job.folder, scene, simulation.rules());
  };
  const PlanFolder folder(job.folder, resolved, job.overwrite, can_reuse);
  // The report and the tables take at least as much again as the resolved store.
  constexpr std::size_t least_report = 600'000;
  expect_room_for_matrix(job.folder, scene, simulation, 2 * resolved.size() + least_report);
  if (watch.begun) watch.begun(scene, simulation);
  expect_no_warnings(scene, job.strict);
  inputs.signals = given_signals(job);
  PlanEnd end;
  end.plan = plan_checked(store, scene, request, std::move(inputs),
                          {job.threads, watch.cancel, watch.progress}, name);
  shorten_names(end.plan.warnings, job.store);
  store.cancel = nullptr;  // the results of an interrupted run are written, too
  const SimulationSummary& summary = end.plan.simulation.summary;
  end.table = table_of(request, end.plan.simulation.matrix, name);
  end.answer = plan_json(end.plan, end.table, scene.labels, false);
  end.is_imprecise = !end.plan.certificate && !end.plan.availability && summary.unmet_error;
  end.is_kept = !end.plan.complete && folder.has_finished_plan();
  const std::string run = run_json(end.plan, clock.effort(job.threads), store_from(job.folder, job.store));
  const std::string answer = plan_json(end.plan, end.table, scene.labels);
  const PlanContents contents{store, scene, resolved, end.plan, answer, run, job.safe_csv};
  if (!end.is_kept)
    write_plan(folder, job.folder, contents);
  else if (!summary.has_all_in_checkpoint)  // samples would be lost
    end.elsewhere = keep_plan_elsewhere(contents);
  if (end.plan.complete) {
    remove_checkpoint(simulation.checkpoint.path);
    remove_checkpoint(job.folder / states_checkpoint_name);
  }
  end.code = code_of(request, end.plan, end.is_imprecise);
  return end;
}

}  // namespace shelfbeam::jobs
