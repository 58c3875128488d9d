#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/placement_file.hpp"

#include "arguments.hpp"
#include "placement_input.hpp"
#include "placement_options.hpp"
#include "terminal.hpp"
#include "verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  QuestionFlags question;
  SolverFlags solver;
  PlacementInput input;
  std::filesystem::path output;
};

int run_place(const Options& options) {
  options.input.keep(options.output);
  const SignalTable table = options.input.table(options.question.question());
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
  add_placement_input(*verb, options->input);
  verb->add_option("-o,--output", options->output, "Write the answer as JSON to this file")->check(a_path());
  add_question_options(*verb, options->question);
  add_solver_options(*verb, options->solver, 60);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam place signal.h5 -o placement.json\n"
      "  shelfbeam place signal.h5 --model non-cooperative --objective links\n"
      "  shelfbeam place matrix.csv --threshold 0.02 --weighted --costs costs.csv");
  verb->callback([options, &chosen] { chosen = [options] { return run_place(*options); }; });
}

}  // namespace shelfbeam::app
