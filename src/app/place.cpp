#include <filesystem>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/placement_file.hpp"
#include "shelfbeam/signal/signal_table.hpp"

#include "arguments.hpp"
#include "placement_options.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  QuestionFlags question;
  SolverFlags solver;
  std::filesystem::path signal, output;
  std::vector<std::filesystem::path> costs;
  double threshold = 0;
};

int run_place(const Options& options) {
  keep_inputs(options.output, {options.signal});
  for (const auto& file : options.costs) keep_inputs(options.output, {file});
  SignalTable table = read_signal_table(options.signal);
  if (options.threshold > 0) set_requirement(table, options.threshold);
  for (const auto& file : options.costs) apply_costs(table, file);
  if (!options.output.empty()) expect_writable(options.output);
  Placement placement;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel_on_signal(), &progress};
    placement = place(table, options.question.question(), options.solver.options(), control);
  }
  const std::string json = placement_json(placement, table);
  if (!options.output.empty()) write_file(options.output, json);
  if (options.common.json)
    fmt::print("{}", json);
  else if (!options.common.quiet)
    fmt::print("{}", describe(placement, table));
  return exit_code(placement);
}

}  // namespace

void add_place(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb = app.add_subcommand("place", "Choose transceivers on a signal matrix, with a proven bound");
  auto options = std::make_shared<Options>();
  verb->add_option("SIGNAL", options->signal,
                   "Signal file (HDF5), CSV, NPY, sparse text, or OR-Library scp or rail file")
      ->required()
      ->check(a_path());
  verb->add_option("-o,--output", options->output, "Write the answer as JSON to this file")->check(a_path());
  add_question_options(*verb, options->question);
  add_solver_options(*verb, options->solver, 60);
  verb->add_option("--threshold", options->threshold, "Requirement of every label, for matrices without one")
      ->check(positive_number());
  verb->add_option("--costs", options->costs,
                   "CSV 'id,cost' of transceivers or 'id,link_cost,signal_cost' of labels; may be repeated");
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam place signal.h5 -o placement.json\n"
      "  shelfbeam place signal.h5 --model non-cooperative --objective links\n"
      "  shelfbeam place matrix.csv --threshold 0.02 --weighted --costs costs.csv");
  verb->callback([options, &chosen] { chosen = [options] { return run_place(*options); }; });
}

}  // namespace shelfbeam::app
