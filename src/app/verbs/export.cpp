#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/model.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/matrix_export.hpp"

#include "app/options/arguments.hpp"
#include "app/options/placement_options.hpp"
#include "app/text/store_summary.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

struct ExportArguments {
  CommonOptions common;
  PlacementProblem problem;
  PlacementInput input;
  std::filesystem::path output;
  std::string what = "mean";
  bool safe_csv = false;
  bool for_model = false, for_matrix = false;  ///< an option for this kind of output was given
};

void export_matrix(const ExportArguments& options) {
  if (options.input.signals.size() > 1)
    throw InputError(options.input.signals[1].string(),
                     "is a second file, but a matrix is exported from one file", "export one file at a time");
  SignalMatrix matrix = read_signal_file(options.input.signals.front());
  for (std::size_t e = 0; e < matrix.mean.size(); ++e) matrix.mean[e] = std::max(0.0F, matrix.mean[e]);
  const auto& values = options.what == "mean"     ? matrix.mean
                       : options.what == "direct" ? matrix.direct
                                                  : matrix.standard_error;
  if (options.output.extension() == ".npy")
    write_matrix_npy(matrix, values, options.output);
  else
    write_matrix_csv(matrix, values, options.output, options.safe_csv);
}

void export_model(const ExportArguments& options) {
  const auto [table, warnings] = options.input.table(options.problem);
  print_warnings(options.common, warnings);
  const PlacementProblem problem = resolved(options.problem, table);
  if (problem.objective != Objective::count && problem.combination == Combination::lexicographic)
    throw InputError(fmt::format("--objective {}", to_text(problem.objective)),
                     "is a secondary objective, but a model file contains only one objective, the count",
                     "add --weighted for one sum, or remove --objective");
  const milp::Model model = placement_model(table, problem);
  if (options.output.extension() == ".lp")
    milp::write_lp(model, options.output);
  else
    milp::write_mps(model, options.output);
}

int run_export(const ExportArguments& options) {
  options.input.keep(options.output);
  const std::string kind = options.output.extension().string();
  const bool is_model = kind == ".mps" || kind == ".lp", is_matrix = kind == ".csv" || kind == ".npy";
  if (is_model && options.for_matrix)
    throw InputError("--what", "chooses a matrix, but the output is a model",
                     "remove it, or write .csv or .npy");
  if (is_matrix && options.for_model)
    throw InputError(
        "--model, --objective, --weighted, --share, --survive-failure, --threshold, --read-as, --costs, "
        "--min-spacing, --forbid",
        "do not apply to a matrix", "remove them, or write .mps or .lp");
  if (options.safe_csv && kind != ".csv")
    throw InputError("--safe-csv", "applies to CSV files only", "remove it, or write .csv");
  if (is_model)
    export_model(options);
  else if (is_matrix)
    export_matrix(options);
  else
    throw InputError(options.output.string(), fmt::format("has the unknown extension '{}'", kind),
                     "use .mps, .lp, .csv or .npy");
  if (options.common.json)
    print_json({{"output", options.output.string()}});
  else if (!options.common.quiet)
    fmt::print("{}\n", options.output.string());
  return done;
}

}  // namespace

void add_export(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("export", "Write the placement model (MPS, LP) or the matrix (CSV, NPY)");
  auto options = std::make_shared<ExportArguments>();
  add_placement_input(*verb, options->input);
  const OptionGroup first(*verb);
  first.require("-o,--output", options->output, a_path(),
                "File to write: .mps or .lp for the model, .csv or .npy for the matrix");
  first.add("--what", options->what, one_of({"mean", "standard-error", "direct"}),
            "Matrix of a signal file to export: mean (default), standard-error or direct");
  add_problem_options(*verb, options->problem);
  add_safe_csv(*verb, options->safe_csv);
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam export signal.h5 -o model.mps --objective links --weighted\n"
      "  shelfbeam export signal.h5 -o errors.csv --what standard-error");
  verb->callback([options, verb, &chosen] {
    options->for_matrix = verb->count("--what") > 0;
    for (const char* flag :
         {"--model", "--objective", "--weighted", "--lexicographic", "--share", "--survive-failure",
          "--threshold", "--read-as", "--costs", "--min-spacing", "--forbid"})
      options->for_model = options->for_model || verb->count(flag) > 0;
    chosen = [options] { return run_export(*options); };
  });
}

}  // namespace shelfbeam::app
