#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/model_file.hpp"
#include "shelfbeam/placement/export_model.hpp"
#include "shelfbeam/signal/matrix_export.hpp"
#include "shelfbeam/signal/signal_file.hpp"
#include "shelfbeam/signal/signal_table.hpp"

#include "arguments.hpp"
#include "placement_options.hpp"
#include "print_json.hpp"
#include "verbs.hpp"

namespace shelfbeam::app {

namespace {

struct Options {
  CommonOptions common;
  QuestionFlags question;
  std::filesystem::path signal, output;
  std::string what = "mean";
  double threshold = 0;
};

void export_matrix(const Options& options) {
  const SignalMatrix matrix = read_signal_file(options.signal);
  const auto& values = options.what == "mean"     ? matrix.mean
                       : options.what == "direct" ? matrix.direct
                                                  : matrix.standard_error;
  if (options.output.extension() == ".npy")
    write_matrix_npy(matrix, values, options.output);
  else
    write_matrix_csv(matrix, values, options.output);
}

void export_model(const Options& options) {
  SignalTable table = read_signal_table(options.signal);
  if (options.threshold > 0) set_requirement(table, options.threshold);
  check_question(table, options.question.question());
  const milp::Model model = placement_model(table, options.question.question());
  if (options.output.extension() == ".lp")
    milp::write_lp(model, options.output);
  else
    milp::write_mps(model, options.output);
}

int run_export(const Options& options) {
  keep_inputs(options.output, {options.signal});
  const std::string kind = options.output.extension().string();
  if (kind == ".mps" || kind == ".lp")
    export_model(options);
  else if (kind == ".csv" || kind == ".npy")
    export_matrix(options);
  else
    throw InputError(options.output.string(), fmt::format("'{}' says nothing about the format", kind),
                     "end the name in .mps, .lp, .csv or .npy");
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
  auto options = std::make_shared<Options>();
  verb->add_option("SIGNAL", options->signal, "Signal file, or any matrix that 'place' reads")
      ->required()
      ->check(a_path());
  verb->add_option("-o,--output", options->output,
                   "File to write: .mps or .lp for the model, .csv or .npy for the matrix")
      ->required()
      ->check(a_path());
  verb->add_option("--what", options->what, "Which matrix")
      ->check(CLI::IsMember({"mean", "standard-error", "direct"}))
      ->capture_default_str();
  add_question_options(*verb, options->question);
  verb->add_option("--threshold", options->threshold, "Requirement of every label, for matrices without one")
      ->check(positive_number());
  add_common_options(*verb, options->common);
  verb->footer(
      "Examples:\n"
      "  shelfbeam export signal.h5 -o model.mps --model non-cooperative --objective links --weighted\n"
      "  shelfbeam export signal.h5 -o errors.csv --what standard-error");
  verb->callback([options, &chosen] { chosen = [options] { return run_export(*options); }; });
}

}  // namespace shelfbeam::app
