#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/report/terminal/coverage_text.hpp"

#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/options/values.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/steps/placement_step.hpp"

namespace shelfbeam::app {

namespace {

struct PlaceArguments {
  CommonOptions common;
  jobs::PlacementQuestion question;
  PlaceOptions solver;
  PlacementInput input;
  std::filesystem::path output;
  std::filesystem::path weights;
  std::filesystem::path start;
};

// The printed object also has the steps of the search and its time, which files omit.
std::string with_effort(const jobs::PlacementAnswer& answer) {
  return fmt::format("{},\n  \"steps\": {},\n  \"seconds\": {:.6g}\n}}\n",
                     answer.json.substr(0, answer.json.rfind("\n}")), steps_json(answer.steps),
                     answer.seconds);
}

void check(const PlaceArguments& options) {
  check_question(options.question.partial, options.question.problem);
  if (!options.weights.empty() && !options.question.partial.is_asked() && !options.question.curve)
    throw InputError("--weights", "applies only if some labels may be missed",
                     "add --at-most, --reach or --curve");
}

int run_place(const PlaceArguments& options) {
  options.input.keep(options.output);
  for (const std::filesystem::path& input : {options.weights, options.start})
    if (!input.empty()) protect_input(options.output, input);
  check(options);
  auto [table, warnings] = options.input.table(options.question.problem);
  if (!options.weights.empty()) apply_weights(table, options.weights);
  PlaceOptions solver = options.solver;
  if (!options.start.empty())
    solver.start =
        jobs::start_of(read_selection(options.start, table), table, options.question, options.start.string());
  if (!options.output.empty()) expect_writable(options.output);
  print_warnings(options.common, warnings);
  jobs::PlacementAnswer answer;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel_on_signal(), progress.sink()};
    answer = jobs::answer(table, options.question, solver, control);
  }
  if (!options.output.empty()) write_file(options.output, answer.json);
  if (options.common.json)
    fmt::print("{}", with_effort(answer));
  else if (!options.common.quiet)
    fmt::print("{}", with_answer(answer.text));
  if (options.question.curve && !answer.has_selection && !options.common.json && !options.common.quiet)
    fmt::print("  {}; '--at-most K' reports the number of labels that K transceivers reach\n", no_curve);
  return answer.code;
}

}  // namespace

void add_place(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("place", "Choose transceivers from a signal matrix, with a proven bound");
  auto options = std::make_shared<PlaceArguments>();
  add_placement_input(*verb, options->input);
  const OptionGroup first(*verb);
  first.add("-o,--output", options->output, a_path(), "Write the placement as JSON to this file");
  add_partial_options(*verb, options->question.partial);
  first
      .add_flag("--curve", options->question.curve,
                "Also print the number of labels that fewer transceivers can reach")
      ->excludes("--at-most")
      ->excludes("--reach");
  first.add("--weights", options->weights, a_path("FILE"),
            "CSV with columns id,weight: weights of labels for --at-most, --reach and --curve; default 1");
  first.add("--start", options->start, a_path("PLACEMENT"),
            "Begin with the selection of this placement.json");
  add_problem_options(*verb, options->question.problem);
  add_solver_options(*verb, options->solver);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam place signal.h5 -o placement.json\n"
      "  shelfbeam place signal.h5 --model non-cooperative --objective links\n"
      "  shelfbeam place matrix.csv --threshold 0.02 --weighted --costs costs.csv\n"
      "  shelfbeam place open.h5 shut.h5 --survive-failure --min-spacing 2\n"
      "  shelfbeam place signal.h5 --at-most 6\n"
      "  shelfbeam place signal.h5 --reach 95% --weights weights.csv");
  verb->callback([options, &chosen] {
    options->solver.seed = options->common.seed;
    chosen = [options] { return run_place(*options); };
  });
}

}  // namespace shelfbeam::app
