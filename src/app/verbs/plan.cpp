#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/open_bound.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/signals.hpp"
#include "shelfbeam/report/terminal/coverage_text.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/report/terminal/plan_text.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/options/simulation_options.hpp"
#include "app/options/usage.hpp"
#include "app/text/end_at_once.hpp"
#include "app/text/flags.hpp"
#include "app/text/simulation_text.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/plan_job.hpp"

namespace shelfbeam::app {

using namespace jobs;

namespace {

struct PlanArguments {
  CommonOptions common;
  PlanJob job;
  double reflectance_error = SensitivityOptions().assumed_error;
  bool sensitivity = false;
};

// Alternatives, curve and sensitivity.
std::string additions(const PlanJob& job, const Plan& plan, const SignalTable& table) {
  const Placement& placement = plan.placement;
  if (plan.availability) return {};
  std::string text = describe(plan.alternatives, placement, table, plan.has_known_thresholds()) +
                     describe(plan.curve, table);
  if (job.plan.curve && !placement.has_selection())
    text +=
        fmt::format("  {}; 'place {} --at-most K' reports the number of labels that K transceivers reach\n",
                    no_curve, (job.folder / signal_name).string());
  if (plan.sensitivity)
    text += fmt::format("sensitivity: {}\n", sensitivity_sentence(english(), plan, table.rows()));
  else if (!job.plan.reflectance_error && placement.has_selection() && !job.selection)
    text += "  darker or lighter surfaces were not examined; '--sensitivity' examines them\n";
  else if (job.plan.reflectance_error)
    text += fmt::format("  no sensitivity {}\n", placement.has_selection()
                                                     ? "yet: the run was stopped before its simulation"
                                                     : "without a placement");
  return text;
}

// The answer comes first, then its open part, then the page that shows it, then the details.
std::string result(const PlanJob& job, const PlanEnd& end) {
  const Plan& plan = end.plan;
  const SignalTable& table = end.table;
  PlanText text = plan_text(plan, table);
  if (plan.certificate) text.answer = with_effort(english(), text.answer, plan.certificate->open);
  Remedy remedy = remedy_for(english(), plan);
  remedy.advice = with_flags(remedy.advice, remedy.settings);
  text.open = remedy.after(text.open);
  for (std::string* line : {&text.basis, &text.open})
    if (!line->empty()) *line += '\n';
  const SimulationSummary& summary = plan.simulation.summary;
  std::string simulated;
  if (plan.signals)
    simulated =
        signals_text(english(), *plan.signals, summary.labels, summary.candidates, job.signal->string());
  if (!plan.signals || std::holds_alternative<MisfitReason>(*plan.signals))
    simulated += describe(summary, job.plan.follows_decision());
  simulated += '\n';
  for (std::size_t at = 0; (at = simulated.find('\n', at) + 1) < simulated.size();)
    simulated.insert(at, "  ");
  const std::string report =
      end.is_kept ? "" : fmt::format("report: {}\n", (job.folder / report_name).string());
  return fmt::format("{}\n{}{}{}{}{}simulation: {}", styled(Style::answer, text.answer), text.basis,
                     text.open, report, text.details, additions(job, plan, table), simulated);
}

std::string remark_on_interruption(const PlanJob& job, const PlanEnd& end) {
  const SimulationSummary& summary = end.plan.simulation.summary;
  std::string next = summary.has_checkpoint ? "repeat the command with '--resume' to continue"
                                            : "there is no checkpoint, so start again";
  if (end.elsewhere) next = fmt::format("the interrupted plan is in '{}'; {}", end.elsewhere->string(), next);
  if (end.is_kept) return fmt::format("the finished plan in {} is unchanged; {}", job.folder.string(), next);
  return fmt::format("{}; {}",
                     summary.complete ? "the simulation is complete, but the later steps are not"
                                      : "the plan uses the samples so far",
                     next);
}

PlanJob job_of(const PlanArguments& options) {
  PlanJob job = options.job;
  job.plan.seed = options.common.seed;
  job.threads = options.common.threads;
  if (options.sensitivity) job.plan.reflectance_error = options.reflectance_error;
  return job;
}

}  // namespace

int run_and_print(const PlanJob& job, const CommonOptions& common) {
  PlanEnd end;
  {
    const CancelToken& cancel = cancel_on_signal();
    std::optional<EndAtOnce> reading(stopped_early);
    TerminalProgress progress(common.quiet);
    end = run_plan(job, {.cancel = &cancel,
                         .progress = progress.sink(),
                         .read = [&] { reading.reset(); },
                         .begun =
                             [&](const Scene& scene, const SimulationOptions& simulation) {
                               print_warnings(common, scene, simulation.rules().strategy);
                             }});
  }
  if (common.json)
    fmt::print("{}", end.answer);
  else if (!common.quiet)
    fmt::print("{}", result(job, end));
  if (common.json && !common.quiet && end.is_imprecise)
    print_message(
        "the requested relative error was not reached; without '--json' the program lists the entries\n");
  if (!end.plan.complete && (!common.quiet || end.elsewhere))
    print_message("stopped early: {}\n", remark_on_interruption(job, end));
  return end.code;
}

namespace {

CLI::App* add_plan(CLI::App& app, PlanArguments* options) {
  CLI::App* verb =
      app.add_subcommand("plan", "Simulate a store, place transceivers, certify and report the plan");
  PlanJob& job = options->job;
  const OptionGroup first(*verb), certificate(*verb, group::certificate);
  first.require("STORE", job.store, a_path(), "Store file (JSON)");
  first.require("-o,--output", job.folder, a_path(), "Folder for the results");
  add_simulation_options(*verb, job.plan.simulation, DirectLight::exact);
  verb->get_option("--samples")
      ->description(
          "Samples per label; default: as many as the certificate needs (with --no-certificate: 10000)");
  OptionGroup(*verb, group::simulation)
      .add("--signal", job.signal, a_path(),
           "Signals to reuse: a signal file, or the folder of an earlier plan. They fit if geometry, "
           "materials and wavelength are the same, and if they contain all labels and candidates; "
           "otherwise, the store is simulated again, with the options of a simulation. The certificate takes "
           "samples of its own");
  add_partial_options(*verb, job.plan.partial);
  add_problem_options(*verb, job.plan.problem);
  add_solver_options(*verb, job.plan.place);
  add_requirement_options(*verb, job.plan.constraints);
  add_unit_options(*verb, job.units);
  add_certificate_options(*verb, job.plan.confidence, job.plan.budget_s);
  certificate.add_flag_call(
      "--no-certificate", [&job] { job.plan.certifies = false; },
      "Do not certify: treat the simulated signals as exact");
  first.add_flag("--curve", job.plan.curve, "Also report how many labels fewer transceivers can reach")
      ->excludes("--at-most")
      ->excludes("--reach");
  auto* sensitivity =
      first.add_flag("--sensitivity", options->sensitivity,
                     "Also determine the effect of uncertain reflectances on the labels that are reached");
  first
      .add("--reflectance-error", options->reflectance_error, a_share("SHARE", {0, 1}),
           fmt::format("With --sensitivity: relative error of reflectances without a given range, e.g. 0.2 "
                       "or 20%; default {}",
                       options->reflectance_error))
      ->needs(sensitivity);
  add_state_options(
      *verb, job.plan.states,
      "States of a shop with 'variation' on which units are placed; default 100; 0: the shop as in "
      "the store file",
      job.plan.goal);
  add_without(*verb, job.without);
  verb->add_option(
          "--sampled", job.sampled,
          "Outputs of 'simulate --states N --for-plan', all parts in any order: the states on which units "
          "are placed, instead of a simulation")
      ->option_text("FILES")
      ->group(group::states);
  add_run_options(*verb, job.plan.simulation, job.checkpoint);
  OptionGroup(*verb, group::runs)
      .add_flag("--overwrite", job.overwrite, "Replace a finished plan in the folder");
  add_store_options(*verb, job.allow_outside);
  add_strict_option(*verb, job.strict);
  add_safe_csv(*verb, job.safe_csv);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam plan store.json -o plan\n"
      "  shelfbeam plan store.json -o plan --curve --sensitivity\n"
      "  shelfbeam plan store.json -o plan --samples 50000\n"
      "  shelfbeam plan store.json -o new --signal plan --pin T7 --exclude 'W*'\n"
      "  shelfbeam plan store.json -o few --signal plan --at-most 8\n"
      "  shelfbeam plan store.json -o plan --survive-failure --min-spacing 2\n"
      "  shelfbeam plan store.json -o plan --confidence 99.9% --budget 1800\n"
      "  shelfbeam plan store.json -o plan --threads 8 --resume\n"
      "Writes report.html (start here), mounting.csv and mounting.dxf (for the fitter),\n"
      "bill.csv, placement.csv, labels.csv, verification.csv, placement.json,\n"
      "signal.h5, the resolved store.json, and run.json (times).");
  return verb;
}

}  // namespace

void add_plan(CLI::App& app, ChosenVerb& chosen) {
  auto options = std::make_shared<PlanArguments>();
  add_plan(app, options.get())->callback([options, &chosen] {
    chosen = [options] { return run_and_print(job_of(*options), options->common); };
  });
}

PlanJob parsed_plan(int argc, const char* const* argv) {
  CLI::App app;
  PlanArguments options;
  add_plan(app, &options);
  parse_command_line(app, argc, argv);
  return job_of(options);
}

}  // namespace shelfbeam::app
