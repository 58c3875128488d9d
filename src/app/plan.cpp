#include "shelfbeam/plan/plan.hpp"

#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/placement_file.hpp"
#include "shelfbeam/placement/words.hpp"
#include "shelfbeam/plan/verification_file.hpp"
#include "shelfbeam/signal/checkpoint.hpp"
#include "shelfbeam/signal/signal_file.hpp"
#include "shelfbeam/signal/signal_table.hpp"

#include "arguments.hpp"
#include "certificate_options.hpp"
#include "loaded_store.hpp"
#include "placement_options.hpp"
#include "plan_folder.hpp"
#include "requirements.hpp"
#include "simulation_options.hpp"
#include "store_table.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  SimulationFlags simulation;
  QuestionFlags question;
  SolverFlags solver;
  CertificateFlags certificate;
  bool without_certificate = false;
  Requirements requirements;
  std::filesystem::path store, folder;
  bool allow_outside = false;

  bool certifies() const { return !without_certificate; }
};

SignalTable table_of(const Options& options, const SignalMatrix& matrix) {
  SignalTable table = make_signal_table(matrix);
  options.requirements.apply(table, options.store.string());
  return table;
}

// A store that is no plan's own stays, and so do the lists that may lie beside it.
void keep_store(const std::filesystem::path& folder, const std::filesystem::path& file,
                const LoadedStore& store) {
  std::error_code missing;
  const auto home = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
  if (std::filesystem::equivalent(folder, home, missing) && read_file(file) != store.resolved)
    throw InputError(folder.string(), "is the folder of the store file, which would be overwritten",
                     "choose another folder for the plan");
}

int run_plan(const Options& options) {
  const LoadedStore store =
      load_store(options.store, options.allow_outside, options.simulation.most_memory());
  keep_store(options.folder, options.store, store);
  // What is asked of the placement is checked before the light is simulated.
  SignalTable nothing = table_without_signals(store.scene);
  options.requirements.apply(nothing, options.store.string());
  const SimulationOptions simulation =
      options.simulation.options(options.common.seed, options.folder / signal_name);
  const bool is_new = !std::filesystem::exists(options.folder);
  prepare_plan_folder(options.folder);
  Plan plan;
  try {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel_on_signal(), progress.sink()};
    PlanOptions asked;
    asked.simulation = simulation;
    asked.question = options.question.question();
    asked.place = options.solver.options(options.common.seed);
    asked.table = [&](const SignalMatrix& matrix) { return table_of(options, matrix); };
    asked.budget_s = options.certificate.budget_s;
    if (options.certifies())
      asked.confidence = options.certificate.confidence;
    else
      asked.confidence.reset();
    plan = make_plan(store.scene, store.hash, asked, control);
  } catch (...) {  // stopped too early, or refused
    std::error_code not_empty;
    if (is_new) std::filesystem::remove(options.folder, not_empty);
    throw;
  }
  const SignalMatrix& matrix = plan.simulation.matrix;
  const SimulationSummary& summary = plan.simulation.summary;
  const SignalTable table = table_of(options, matrix);
  const std::string answer = placement_json(plan.placement, table);
  write_file(options.folder / store_name, store.resolved);
  write_signal_file(matrix, options.folder / signal_name);
  write_file(options.folder / placement_name, answer);
  const bool is_certified = plan.placement.certificate.has_value();
  if (is_certified)
    write_file(options.folder / verification_name,
               verification_csv(*plan.placement.certificate, store.scene));
  else
    std::filesystem::remove(options.folder / verification_name);  // of another plan
  write_report(options.folder, {store.scene, matrix, plan.placement});
  if (summary.complete) remove_checkpoint(simulation.checkpoint.path);

  if (options.common.json)
    fmt::print("{}", answer);
  else if (!options.common.quiet)
    fmt::print("{}\n{}{}report: {}\n", describe(summary), describe(plan.placement, table),
               is_certified ? fmt::format("certificate: {}\n", statement(plan.placement)) : "",
               (options.folder / report_name).string());
  if (summary.complete) {
    const int code = exit_code(plan.placement.status);
    return code == done && is_certified && !plan.placement.certificate->open.empty() ? stopped_early : code;
  }
  if (!options.common.quiet)
    fmt::print(
        stderr,
        "stopped early: the plan rests on the samples so far; the same command with '--resume' goes on\n");
  return stopped_early;
}

}  // namespace

void add_plan(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("plan", "Simulate a store, place transceivers, and write the report");
  auto options = std::make_shared<Options>();
  verb->add_option("STORE", options->store, "Store file")->required()->check(a_path());
  verb->add_option("-o,--output", options->folder, "Folder for the results")->required()->check(a_path());
  add_simulation_options(*verb, options->simulation, "exact");
  add_question_options(*verb, options->question);
  add_solver_options(*verb, options->solver, 60);
  add_requirement_options(*verb, options->requirements);
  add_certificate_options(*verb, options->certificate);
  verb->add_flag("--no-certificate", options->without_certificate,
                 "Place on the simulated matrix as it is, and say nothing of its errors");
  add_store_options(*verb, options->allow_outside);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam plan store.json -o plan\n"
      "  shelfbeam plan store.json -o plan --samples 50000 --model non-cooperative --objective links\n"
      "Writes signal.h5, placement.json, verification.csv, placement.csv, labels.csv, store.json (resolved) "
      "and\n"
      "report.html.");
  verb->callback([options, &chosen] { chosen = [options] { return run_plan(*options); }; });
}

}  // namespace shelfbeam::app
