#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/coverage_curve.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/report/terminal/coverage_text.hpp"

#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/options/values.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct PlaceArguments {
  CommonOptions common;
  PlacementProblem problem;
  PlaceOptions solver;
  PlacementInput input;
  std::filesystem::path output;
  std::filesystem::path weights;
  std::filesystem::path start;
  PartialQuestion question;
  bool curve = false;
};

struct Answer {
  std::string json, text;
  int code = done;
  double seconds = 0;
  std::vector<SearchStep> steps = {};
};

// The printed object also has the steps of the search and its time, which files omit.
std::string with_effort(const Answer& answer) {
  return fmt::format("{},\n  \"steps\": {},\n  \"seconds\": {:.6g}\n}}\n",
                     answer.json.substr(0, answer.json.rfind("\n}")), steps_json(answer.steps),
                     answer.seconds);
}

Answer reach(const PlaceArguments& options, const SignalTable& table, const PlaceOptions& solver,
             const RunControl& control) {
  if (options.question.share) {
    const FewestUnits fewest = fewest_units(table, options.problem, *options.question.share, solver, control);
    return {fewest_units_json(fewest, table), describe(fewest, table), jobs::exit_code_of(fewest.status),
            fewest.seconds, fewest.steps};
  }
  const MaxCoverage reach =
      maximise_coverage(table, options.problem, *options.question.at_most, solver, control);
  return {coverage_json(reach, table), describe(reach, table), jobs::exit_code_of(reach.status),
          reach.seconds, reach.steps};
}

Answer cover(const PlaceArguments& options, const SignalTable& table, const PlaceOptions& solver,
             const RunControl& control) {
  Placement placement = place(table, options.problem, solver, control);
  CoverageCurve curve;
  std::string remark;
  if (options.curve && placement.has_selection()) {
    curve = add_curve(placement, table, solver.time_limit_s, control);
  } else if (options.curve) {
    remark =
        fmt::format("  {}; '--at-most K' reports the number of labels that K transceivers reach\n", no_curve);
  }
  return {placement_json(placement, table, curve),
          describe(placement, table) + describe(curve, table) + remark,
          curve.is_complete ? jobs::exit_code_of(placement.status) : stopped_early, placement.seconds,
          std::move(placement.steps)};
}

void check(const PlaceArguments& options) {
  check_question(options.question, options.problem);
  if (!options.weights.empty() && !options.question.is_asked() && !options.curve)
    throw InputError("--weights", "applies only if some labels may be missed",
                     "add --at-most, --reach or --curve");
}

// The selection of a placement.json with the installed units, with which the search begins.
std::vector<std::uint32_t> read_start(const PlaceArguments& options, const SignalTable& table) {
  std::vector<std::uint32_t> selected = read_selection(options.start, table);
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed && !std::binary_search(selected.begin(), selected.end(), j))
      selected.insert(std::lower_bound(selected.begin(), selected.end(), j), j);
  const Check check = check_selection(table, resolved(options.problem, table), selected);
  const auto fail = [&](const std::string& problem) {
    throw InputError(options.start.string(), problem,
                     "use a selection that answers this question, or omit --start");
  };
  if (!check.allowed()) fail("selects units that exclude one another");
  if (!options.question.is_asked() && !check.met())
    fail(fmt::format("does not reach {} of {} labels", check.unmet.size(), table.rows()));
  if (options.question.at_most && selected.size() > *options.question.at_most)
    fail(fmt::format("selects {} units, more than --at-most {}", selected.size(), *options.question.at_most));
  return selected;
}

int run_place(const PlaceArguments& options) {
  options.input.keep(options.output);
  for (const std::filesystem::path& input : {options.weights, options.start})
    if (!input.empty()) protect_input(options.output, input);
  check(options);
  auto [table, warnings] = options.input.table(options.problem);
  if (!options.weights.empty()) apply_weights(table, options.weights);
  PlaceOptions solver = options.solver;
  if (!options.start.empty()) solver.start = read_start(options, table);
  if (!options.output.empty()) expect_writable(options.output);
  print_warnings(options.common, warnings);
  Answer answer;
  {
    TerminalProgress progress(options.common.quiet);
    const RunControl control{options.common.threads, &cancel_on_signal(), progress.sink()};
    answer = options.question.is_asked() ? reach(options, table, solver, control)
                                         : cover(options, table, solver, control);
  }
  if (!options.output.empty()) write_file(options.output, answer.json);
  if (options.common.json)
    fmt::print("{}", with_effort(answer));
  else if (!options.common.quiet)
    fmt::print("{}", with_answer(answer.text));
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
  add_partial_options(*verb, options->question);
  first
      .add_flag("--curve", options->curve,
                "Also print the number of labels that fewer transceivers can reach")
      ->excludes("--at-most")
      ->excludes("--reach");
  first.add("--weights", options->weights, a_path("FILE"),
            "CSV with columns id,weight: weights of labels for --at-most, --reach and --curve; default 1");
  first.add("--start", options->start, a_path("PLACEMENT"),
            "Begin with the selection of this placement.json");
  add_problem_options(*verb, options->problem);
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
