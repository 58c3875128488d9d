#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/plan/io/plan_file.hpp"
#include "shelfbeam/plan/io/scene_table.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/states/verify_states.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/known_values.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/scene/store/store.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/transport/states/simulate_states.hpp"

#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/options/simulation_options.hpp"
#include "app/text/end_at_once.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_job.hpp"
#include "jobs/steps/verification_step.hpp"

namespace shelfbeam::app {

using jobs::PlanJob;

namespace {

struct VerifyArguments {
  CommonOptions common;
  SimulationFlags simulation;
  double confidence = 0.99, budget_s = 600;  ///< of the certificate
  std::optional<CommunicationModel> model;
  std::optional<std::uint32_t> states;
  AvailabilityGoal goal;
  std::vector<Cause> without;
  bool survive_failure = false;
  std::filesystem::path store, placement, output;
  std::optional<std::filesystem::path> signal;  ///< of the report
  bool allow_outside = false, safe_csv = false, overwrite = false;
};

jobs::Installation load_installation(const VerifyArguments& options) {
  const CancelToken& cancel = cancel_on_signal();
  const EndAtOnce reading(stopped_early);
  Store store = read_store(options.store, {.allow_outside = options.allow_outside,
                                           .memory = options.simulation.memory,
                                           .output = options.output,
                                           .cancel = &cancel});
  leave_out(store, options.without);
  jobs::Installation installation = jobs::installation_of(store, options.placement, options.store);
  PlacementProblem& problem = installation.problem;
  problem.model = options.model.value_or(problem.model);
  problem.redundant = problem.redundant || options.survive_failure;
  return installation;
}

// A new name without the ending of a table is the folder of a report.
bool is_folder(const std::filesystem::path& output) {
  if (std::filesystem::exists(output)) return std::filesystem::is_directory(output);
  return !output.empty() && output.extension() != ".csv";
}

PlanJob job_of(const VerifyArguments& options) {
  PlanJob job{.store = options.store, .folder = options.output, .selection = options.placement};
  job.plan.seed = options.common.seed;
  job.plan.simulation = options.simulation;
  job.plan.problem.redundant = options.survive_failure;
  job.model = options.model;
  job.plan.confidence = options.confidence;
  job.plan.budget_s = options.budget_s;
  job.signal = options.signal;
  job.threads = options.common.threads;
  job.checkpoint = options.simulation.checkpoint;
  job.allow_outside = options.allow_outside;
  job.overwrite = options.overwrite;
  job.safe_csv = options.safe_csv;
  return job;
}

int verify_in_states(const VerifyArguments& options, const jobs::Installation& installation,
                     const SimulationOptions& simulation) {
  const Scene& units = installation.scene;
  const SignalTable table = table_without_signals(units);
  Availability found;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel_on_signal(), progress.sink()};
    const std::filesystem::path log_path = options.output.empty() ? "" : simulation.checkpoint.path;
    ResultLog log = log_of_states(log_path, make_scene(installation.store).store_hash, simulation);
    const VerifyStatesOptions how{*options.states, options.goal, options.confidence, simulation};
    try {
      found = jobs::verify_in_states(installation, how, log, control);
    } catch (const Interrupted&) {
      log.flush();
      if (!options.common.quiet)
        print_message("stopped early: {}\n", log_path.empty()
                                                 ? "with '--output', the run can be continued"
                                                 : "repeat the command with '--resume' to continue");
      return stopped_early;
    }
  }
  if (!options.output.empty()) {
    write_file(options.output, availability_csv(found, units, options.safe_csv));
    remove_checkpoint(simulation.checkpoint.path);
  }
  Placement mounted;
  mounted.problem = installation.problem;
  mounted.selected.resize(units.transceivers.size());
  std::iota(mounted.selected.begin(), mounted.selected.end(), 0U);
  if (options.common.json)
    fmt::print("{}", availability_text(found, table));
  else if (!options.common.quiet)
    fmt::print("{}\n{}", styled(Style::answer, availability_answer(found, mounted, table)),
               availability_details(found, mounted, table));
  return jobs::exit_code_of(found);
}

int run_verify(const VerifyArguments& options) {
  if (is_folder(options.output)) {
    expect_no_goal(options.goal, options.without);
    if (options.states.value_or(0) > 0)
      throw InputError(options.output.string(), "is the folder of a report, which has no states",
                       "name a CSV file with the ending .csv");
    return run_and_print(job_of(options), options.common);
  }
  if (options.signal || options.overwrite)
    throw InputError(options.signal ? "--signal" : "--overwrite", "applies to the folder of a report",
                     "name a folder with --output");
  protect_input(options.output, options.store);
  if (!options.placement.empty()) protect_input(options.output, options.placement);
  const jobs::Installation installation = load_installation(options);
  if (options.states.value_or(0) > 0)
    expect_variation(installation.store);
  else
    expect_no_goal(options.goal, options.without);
  if (!options.output.empty()) expect_writable(options.output);
  const SimulationOptions simulation = options.simulation.options(options.common.seed, options.output);
  print_warnings(options.common, installation.scene, simulation.rules().strategy);
  if (options.states.value_or(0) > 0) return verify_in_states(options, installation, simulation);
  CertifiedPlan verified;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel_on_signal(), progress.sink()};
    CertifyOptions certify_options;
    certify_options.confidence = options.confidence;
    certify_options.budget.seconds = options.budget_s;
    certify_options.simulation = simulation;
    certify_options.simulation.checkpoint = {};
    verified = verify_installation(installation.scene, installation.problem, certify_options, control);
  }
  const Certificate& certificate = *verified.certificate;
  if (!options.output.empty())
    write_file(options.output, verification_csv(certificate, installation.scene, options.safe_csv));
  if (options.common.json) {
    fmt::print("{}", certificate_json(certificate, table_without_signals(installation.scene)));
  } else if (!options.common.quiet) {
    fmt::print("{}\n", styled(Style::answer, with_effort(english(), certificate_sentence(english(), verified),
                                                         certificate.open)));
    verified.values = installation.scene.values;
    verified.is_example = installation.scene.source == ValueSource::example;
    if (const std::string basis = basis_of(english(), verified, certificate.all_reached()); !basis.empty())
      fmt::print("{}\n", basis);
  }
  return jobs::exit_code_of(certificate);
}

}  // namespace

void add_verify(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("verify", "Verify which labels a placement or mounted units reach");
  auto options = std::make_shared<VerifyArguments>();
  const OptionGroup first(*verb);
  first.require("STORE", options->store, a_path(), "Store file (JSON)");
  first.add("PLACEMENT", options->placement, a_path(),
            "placement.json, or a CSV of mounted units with the columns id,x,y,z,ax,ay,az,roll_deg,type; "
            "default: the selected, pinned and installed units of the store");
  first.add("-o,--output", options->output, a_path(),
            "Write one row per label to this CSV file; another name than *.csv is a folder, for the report "
            "on these units with all files of a plan");
  first.add_choice("--model", options->model,
                   "Communication model; default: the model of the placement, or cooperative for a CSV");
  first.add_flag("--survive-failure", options->survive_failure,
                 "Every label must be reached even if any one unit fails, including installed units");
  add_certificate_options(*verb, options->confidence, options->budget_s);
  add_state_options(*verb, options->states,
                    "Examine the units in this many states of a shop with 'variation', and name the best "
                    "addition",
                    options->goal);
  add_without(*verb, options->without);
  add_simulation_options(*verb, options->simulation, DirectLight::exact);
  add_run_options(*verb, options->simulation, options->simulation.checkpoint);
  OptionGroup(*verb, group::simulation)
      .add("--signal", options->signal, a_path(), "With a folder: signals to reuse, as for plan --signal");
  OptionGroup(*verb, group::runs)
      .add_flag("--overwrite", options->overwrite, "With a folder: replace a finished plan in it");
  add_store_options(*verb, options->allow_outside);
  add_safe_csv(*verb, options->safe_csv)->needs("--output");
  finish_verb(*verb, chosen, options, run_verify,
              "Examples:\n"
              "  shelfbeam verify store.json plan/placement.json\n"
              "  shelfbeam verify store.json\n"
              "  shelfbeam verify store.json installed.csv -o verification.csv\n"
              "  shelfbeam verify store.json changed.json -o changed --signal plan\n"
              "  shelfbeam verify store.json installed.csv --states 1000");
}

}  // namespace shelfbeam::app
