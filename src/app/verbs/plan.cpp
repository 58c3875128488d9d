#include "shelfbeam/plan/plan.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"
#include "shelfbeam/plan/states/plan_states.hpp"
#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/signal/hdf5/write_signal_file.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

#include "app/exit_details.hpp"
#include "app/files.hpp"
#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/options/simulation_options.hpp"
#include "app/plan_folder.hpp"
#include "app/text/coverage_text.hpp"
#include "app/text/end_at_once.hpp"
#include "app/text/placement_text.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/text/variation_text.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct PlanArguments {
  CommonOptions common;
  SimulationFlags simulation;
  PlacementProblem problem;
  PlaceOptions solver;
  CertificateFlags certificate;
  bool no_certificate = false, curve = false, sensitivity = false;
  double reflectance_error = SensitivityOptions().assumed_error;
  Requirements requirements;
  std::filesystem::path store, folder, signal;
  std::vector<std::filesystem::path> sampled;
  std::optional<std::uint32_t> states;  ///< 0: the shop as the file gives it
  AvailabilityGoal goal;
  bool allow_outside = false, strict = false, overwrite = false, safe_csv = false;
};

SignalTable table_of(const PlanArguments& options, const SignalMatrix& matrix) {
  SignalTable table = make_signal_table(matrix);
  options.requirements.apply(table, options.store.string());
  return table;
}

// Alternatives, curve and sensitivity.
std::string additions(const PlanArguments& options, const Plan& plan, const SignalTable& table) {
  const Placement& placement = plan.placement;
  if (plan.availability) return {};
  std::string text = describe(plan.alternatives, placement, table) + describe(plan.curve, table);
  if (options.curve && !placement.has_selection())
    text +=
        fmt::format("  {}; 'place {} --at-most K' reports the number of labels that K transceivers reach\n",
                    no_curve, (options.folder / signal_name).string());
  if (plan.sensitivity)
    text += fmt::format("sensitivity: {}\n", sensitivity_sentence(*plan.sensitivity, table.rows()));
  else if (!options.sensitivity && placement.has_selection())
    text += "  darker or lighter surfaces were not examined; '--sensitivity' examines them\n";
  else if (options.sensitivity)
    text += fmt::format("  no sensitivity {}\n", placement.has_selection()
                                                     ? "yet: the run was stopped before its simulation"
                                                     : "without a placement");
  return text;
}

// The answer comes first, then the page that shows it, then the details.
std::string result(const PlanArguments& options, const Plan& plan, const SignalTable& table,
                   bool follows_decision, bool is_kept) {
  std::string placed = describe(plan.placement, table);
  std::string answer = plan.availability ? availability_answer(*plan.availability, plan.placement, table)
                                         : certificate_sentence(plan);
  if (plan.availability) {
    placed = availability_details(*plan.availability, plan.placement);
    if (!plan.availability->is_impossible()) {
      placed += chosen(plan.placement.selected, table);
      if (const std::string price = price_sentence(plan.placement); !price.empty())
        placed += fmt::format("  {}\n", price);
    }
  } else if (answer.empty()) {
    const std::size_t end = placed.find('\n');
    answer = placed.substr(0, end);
    placed.erase(0, end + 1);
    if (plan.placement.has_selection()) answer += " Not verified yet.";
  } else {
    placed = "on the simulated signals: " + placed;
  }
  const SimulationSummary& summary = plan.simulation.summary;
  std::string simulated = options.signal.empty()
                              ? describe(summary, follows_decision) + '\n'
                              : fmt::format("{} labels x {} candidates, read from {}\n", summary.labels,
                                            summary.candidates, options.signal.string());
  for (std::size_t at = 0; (at = simulated.find('\n', at) + 1) < simulated.size();)
    simulated.insert(at, "  ");
  const std::string report =
      is_kept ? "" : fmt::format("report: {}\n", (options.folder / report_name).string());
  return fmt::format("{}\n{}{}{}simulation: {}", styled(Style::answer, answer), report, placed,
                     additions(options, plan, table), simulated);
}

// The requested relative error was not reached, and no certificate covers the sampling error.
bool is_imprecise(const Plan& plan) {
  return !plan.certificate && !plan.availability && plan.simulation.summary.unmet_error;
}

// A requested result about the selection is incomplete.
bool is_open(const PlanArguments& options, const Plan& plan) {
  const auto& availability = plan.availability;
  if (availability)
    return !availability->is_impossible() &&
           (options.no_certificate ? availability->sample_selected.empty() : !availability->certified);
  return is_imprecise(plan) || (plan.certificate && plan.certificate->open) ||
         !plan.curve.is_complete ||
         (options.sensitivity && plan.placement.has_selection() && !plan.sensitivity);
}

// Whether the certificate decides how many samples are taken where.
bool follows_decision(const PlanArguments& options) {
  const SimulationFlags& flags = options.simulation;
  return !options.no_certificate && !flags.samples && !flags.relative_error && !flags.time_s;
}

// `own`: the folder of this run; null elsewhere, where there are no other files.
void write_plan(const std::filesystem::path& folder, const PlanFolder* own, const Store& store,
                const Scene& scene, const std::string& resolved, const Plan& plan, const std::string& answer,
                bool safe_csv) {
  const SignalMatrix& matrix = plan.simulation.matrix;
  AtomicFolder files(folder);
  files.add(store_name).write(resolved);
  write_signal_file(matrix, files.add(signal_name));
  if (plan.certificate)
    files.add(verification_name).write(verification_csv(*plan.certificate, scene, safe_csv));
  if (plan.availability && plan.availability->has_answer())
    files.add(verification_name).write(availability_csv(*plan.availability, scene, safe_csv));
  write_report(files, {scene, matrix, plan, safe_csv, shop_states(store, scene, matrix, plan)});
  const FileHashes hashes = hashes_of(files);
  files.add(placement_name).write(recorded_placement(answer, plan.complete, hashes));
  if (own)
    own->commit(files, hashes);
  else
    files.commit({});
}

// A plan that cannot be written to its folder is written elsewhere.
void save(const PlanArguments& options, const PlanFolder& folder, const Store& store, const Scene& scene,
          const std::string& resolved, const Plan& plan, const std::string& answer) {
  const auto write = [&](const std::filesystem::path& path, const PlanFolder* own) {
    write_plan(path, own, store, scene, resolved, plan, answer, options.safe_csv);
  };
  try {
    write(options.folder, &folder);
  } catch (const OutputError& error) {
    const auto elsewhere = keep_elsewhere([&](const std::filesystem::path& path) { write(path, nullptr); });
    std::string kept = elsewhere ? fmt::format("the plan is kept in '{}'", elsewhere->string()) : "";
    const SimulationSummary& summary = plan.simulation.summary;
    if (!summary.has_checkpoint) {
      if (!elsewhere) throw;
      throw OutputError(error, kept, Setting::none);
    }
    if (elsewhere) kept += "; ";
    kept += summary.has_all_in_checkpoint ? checkpoint_remains : older_checkpoint;
    throw OutputError(error, kept, Setting::resumption);
  }
}

// `elsewhere`: the folder of the interrupted plan if it could not be continued otherwise.
std::string remark_on_interruption(const PlanArguments& options, const SimulationSummary& summary,
                                   bool is_kept, const std::optional<std::filesystem::path>& elsewhere) {
  std::string next = summary.has_checkpoint ? "repeat the command with '--resume' to continue"
                                            : "there is no checkpoint, so start again";
  if (elsewhere) next = fmt::format("the interrupted plan is in '{}'; {}", elsewhere->string(), next);
  if (is_kept) return fmt::format("the finished plan in {} is unchanged; {}", options.folder.string(), next);
  return fmt::format("{}; {}",
                     summary.complete ? "the simulation is complete, but the later steps are not"
                                      : "the plan uses the samples so far",
                     next);
}

// The states on which units are placed; 0 for the shop as the file gives it.
std::uint32_t states_of(const PlanArguments& options, const Store& store) {
  const std::uint32_t states = options.states.value_or(store.variation ? StatesOptions().sample : 0);
  if (states == 0) {
    expect_no_goal(options.goal);
    return 0;
  }
  expect_variation(store);
  const auto refuse = [](const std::string& option, const std::string& problem) {
    throw InputError(option, problem, "omit it, or plan the shop as in the store file with '--states 0'");
  };
  if (options.curve) refuse("--curve", "does not apply to a shop that changes");
  if (options.sensitivity)
    refuse("--sensitivity", "does not apply to a shop that changes: reflectances are at their low ends");
  if (options.problem.objective != Objective::count || options.problem.combination == Combination::weighted)
    refuse("--objective", "does not apply to a shop that changes: the count or the price is minimised");
  return states;
}

int run_plan(const PlanArguments& options) {
  const CancelToken& cancel = cancel_on_signal();
  std::optional<EndAtOnce> reading(public_exit_code(interrupted));
  Store store = load_store(options.store, options.allow_outside, options.simulation.memory, {}, &cancel);
  const std::uint32_t states = states_of(options, store);
  const Scene scene = make_inspected_scene(store);
  const std::string resolved = resolved_store_json(store, scene);
  protect_store(options.folder, options.store, resolved);
  // Reports errors in the placement options before the simulation.
  SignalTable nothing = table_without_signals(scene);
  options.requirements.apply(nothing, options.store.string());
  SimulationOptions simulation =
      options.simulation.options(options.common.seed, options.folder / signal_name);
  simulation.checkpoint.at_end = true;
  const std::filesystem::path states_log = options.folder / states_checkpoint_name;
  if (follows_decision(options)) simulation.samples = decision_samples;
  std::optional<SampledStates> sampled;
  if (!options.sampled.empty()) {
    if (states == 0) throw InputError("--sampled", "applies to a shop that changes only", "omit it");
    sampled.emplace(options.sampled);
    sampled->expect(scene.store_hash, options.common.seed, scene.labels.size(), scene.transceivers.size(),
                    states);
  }
  reading.reset();
  const PlanFolder folder(options.folder, resolved, options.overwrite);
  // The report and the tables take at least as much again as the resolved store.
  constexpr std::size_t least_report = 600'000;
  expect_room_for_matrix(options.folder, scene, simulation, 2 * resolved.size() + least_report);
  print_warnings(options.common, scene, simulation.rules().strategy);
  expect_no_warnings(scene, options.strict);
  Plan plan;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel, progress.sink()};
    PlanOptions plan_options;
    plan_options.simulation = simulation;
    if (!options.signal.empty()) plan_options.matrix = read_signal_file(options.signal);
    plan_options.problem = options.problem;
    plan_options.place = options.solver;
    plan_options.place.seed = options.common.seed;
    plan_options.table = [&](const SignalMatrix& matrix) { return table_of(options, matrix); };
    const double confidence = options.certificate.confidence;
    plan_options.confidence = options.no_certificate ? std::nullopt : std::optional(confidence);
    plan_options.budget.seconds = options.certificate.budget_s;
    plan_options.curve = options.curve;
    plan_options.alternatives = true;
    if (options.sensitivity) plan_options.sensitivity = {options.reflectance_error, confidence};
    if (states > 0) {
      plan_options.confidence.reset();
      plan_options.alternatives = false;
      // The plan for the shop as the file gives it is only the beginning.
      plan_options.place.time_limit_s /= 4;
    }
    plan = make_plan(scene, std::move(plan_options), control);
    if (states > 0 && plan.complete && plan.placement.has_selection()) {
      StatesOptions over{.sample = states,
                         .sampled = sampled ? &*sampled : nullptr,
                         .goal = options.goal,
                         .confidence = confidence,
                         .certifies = !options.no_certificate,
                         .budget_s = options.certificate.budget_s,
                         .simulation = simulation,
                         .place = options.solver};
      over.place.seed = options.common.seed;
      ResultLog log = log_of_states(states_log, scene.store_hash, simulation);
      PlanOverStates found = plan_over_states(store, scene, table_of(options, plan.simulation.matrix),
                                              plan.placement, over, log, control);
      plan.placement = std::move(found.placement);
      plan.availability = std::move(found.availability);
      plan.availability->assumed = assumed_lines(store);
      plan.complete = !control.cancelled();
    }
    // The report may travel; it names the files of the store without the folder.
    const std::string home = (options.store.parent_path() / "").string();
    for (std::string& warning : plan.warnings)
      if (warning.starts_with(home)) warning.erase(0, home.size());
  }
  store.cancel = nullptr;  // the results of an interrupted run are written, too
  const SimulationSummary& summary = plan.simulation.summary;
  const SignalTable table = table_of(options, plan.simulation.matrix);
  const std::string answer = plan_json(plan, table);
  // An interrupted run never replaces a finished plan.
  const bool is_kept = !plan.complete && folder.has_finished_plan();
  std::optional<std::filesystem::path> elsewhere;
  if (!is_kept)
    save(options, folder, store, scene, resolved, plan, answer);
  else if (!summary.has_all_in_checkpoint)  // samples would be lost
    elsewhere = keep_elsewhere([&](const std::filesystem::path& path) {
      write_plan(path, nullptr, store, scene, resolved, plan, answer, options.safe_csv);
    });
  if (plan.complete) {
    remove_checkpoint(simulation.checkpoint.path);
    remove_checkpoint(states_log);
  }

  if (options.common.json)
    fmt::print("{}", answer);
  else if (!options.common.quiet)
    fmt::print("{}", result(options, plan, table, follows_decision(options), is_kept));
  if (options.common.json && !options.common.quiet && is_imprecise(plan))
    print_message(
        "the requested relative error was not reached; without '--json' the program lists the entries\n");
  if (plan.complete && plan.availability && plan.availability->is_impossible()) return answer_is_no;
  if (plan.complete && !is_open(options, plan))
    return plan.availability || is_certified_minimum(plan) ? done : exit_code(plan.placement.status);
  if (plan.complete) return stopped_early;
  if (!options.common.quiet || elsewhere)
    print_message("stopped early: {}\n", remark_on_interruption(options, summary, is_kept, elsewhere));
  return interrupted;
}

}  // namespace

void add_plan(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("plan", "Simulate a store, place transceivers, certify and report the plan");
  auto options = std::make_shared<PlanArguments>();
  add_path(*verb, "STORE", options->store, "Store file (JSON)")->required();
  add_path(*verb, "-o,--output", options->folder, "Folder for the results")->required();
  add_simulation_options(*verb, options->simulation, DirectLight::exact);
  verb->get_option("--samples")
      ->description(
          "Samples per label; default: as many as the certificate needs (with --no-certificate: 10000)");
  auto* signal =
      add_path(*verb, "--signal", options->signal,
               "Signal file of this store from 'simulate' or 'merge', instead of a simulation; the "
               "certificate still takes samples of its own")
          ->group(group::simulation);
  for (const char* other : {"--samples", "--relative-error", "--time"}) signal->excludes(other);
  add_problem_options(*verb, options->problem);
  add_solver_options(*verb, options->solver);
  add_requirement_options(*verb, options->requirements);
  add_certificate_options(*verb, options->certificate);
  verb->add_flag("--no-certificate", options->no_certificate,
                 "Do not certify: treat the simulated signals as exact")
      ->group(group::certificate);
  verb->add_flag("--curve", options->curve, "Also report how many labels fewer transceivers can reach");
  auto* sensitivity =
      verb->add_flag("--sensitivity", options->sensitivity,
                     "Also determine the effect of uncertain reflectances on the labels that are reached");
  verb->add_option("--reflectance-error", options->reflectance_error,
                   fmt::format("With --sensitivity: relative error of reflectances without a given range, "
                               "e.g. 0.2 or 20%; default {}",
                               options->reflectance_error))
      ->transform(a_share({0, 1}))
      ->option_text("SHARE")
      ->needs(sensitivity);
  add_state_options(
      *verb, options->states,
      "States of a shop with 'variation' on which units are placed; default 100; 0: the shop as in "
      "the store file",
      options->goal);
  verb->add_option(
          "--sampled", options->sampled,
          "Outputs of 'simulate --states N --for-plan', all parts in any order: the states on which units "
          "are placed, instead of a simulation")
      ->option_text("FILES")
      ->group(group::states);
  add_run_options(*verb, options->simulation);
  verb->add_flag("--overwrite", options->overwrite, "Replace a finished plan in the folder")
      ->group(group::runs);
  add_store_options(*verb, options->allow_outside);
  add_strict_option(*verb, options->strict);
  add_safe_csv(*verb, options->safe_csv);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam plan store.json -o plan\n"
      "  shelfbeam plan store.json -o plan --curve --sensitivity\n"
      "  shelfbeam plan store.json -o plan --samples 50000\n"
      "  shelfbeam plan store.json -o plan --signal signal.h5\n"
      "  shelfbeam plan store.json -o plan --survive-failure --min-spacing 2\n"
      "  shelfbeam plan store.json -o plan --confidence 99.9% --budget 1800\n"
      "  shelfbeam plan store.json -o plan --threads 8 --resume\n"
      "Writes report.html (start here), mounting.csv and mounting.dxf (for the fitter),\n"
      "placement.csv, labels.csv, verification.csv, placement.json, signal.h5 and the\n"
      "resolved store.json.");
  verb->callback([options, &chosen] { chosen = [options] { return run_plan(*options); }; });
}

}  // namespace shelfbeam::app
