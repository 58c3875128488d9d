#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/report/comparison/comparison_json.hpp"
#include "shelfbeam/report/comparison/comparison_report.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/comparison.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/measured/comparison.hpp"
#include "shelfbeam/signal/measured/measurements.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "app/options/arguments.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"

namespace shelfbeam::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t listed = 5;  // worst pairs in the text

struct CompareArguments {
  CommonOptions common;
  fs::path signal, measured, placement, output;
  double confidence = 0.95;
  bool safe_csv = false;
};

/// The paths of the table and the page; empty: not written.
struct Outputs {
  fs::path table, page;
};

Outputs outputs_of(const CompareArguments& options) {
  const fs::path& output = options.output;
  if (output.empty()) return {};
  if (output.extension() == ".csv") return {output, {}};
  if (output.extension() == ".html") return {{}, output};
  if (!output.extension().empty() && !fs::is_directory(output))
    throw InputError(output.string(),
                     fmt::format("has the unknown extension '{}'", output.extension().string()),
                     "use .csv or .html, or name a folder for both");
  return {output / "comparison.csv", output / "comparison.html"};
}

/// Throws InputError where an output cannot be written or is an input.
void prepare(const CompareArguments& options, const Outputs& outputs) {
  const bool to_folder = !outputs.table.empty() && !outputs.page.empty();
  if (to_folder) make_output_folder(options.output);
  for (const fs::path& output : {outputs.table, outputs.page}) {
    if (output.empty()) continue;
    for (const fs::path& input : {options.signal, options.measured, options.placement})
      if (!input.empty()) protect_input(output, input);
    expect_writable(output);
  }
}

Selection units_of(const CompareArguments& options, const SignalMatrix& matrix,
                   const Measurements& measurements) {
  if (measurements.of_pairs) {
    if (!options.placement.empty())
      throw InputError(options.measured.string(),
                       "names a transceiver for every signal, so a placement does not apply",
                       "remove --placement, or the column 'transceiver'");
    return {};
  }
  if (options.placement.empty())
    throw InputError(options.measured.string(),
                     "has no column 'transceiver', so several units were on at once",
                     "name these units with --placement");
  const SignalTable table = make_signal_table(matrix, options.signal.string());
  Selection units = read_placement(options.placement, table).selected;
  if (units.empty())
    throw InputError(options.placement.string(), "selects no transceiver", "use another placement");
  return units;
}

void print_pairs(const ComparisonInput& input, const std::string& heading,
                 const std::vector<std::size_t>& pairs) {
  const Words words = english();
  fmt::print("{}\n", heading);
  std::vector<std::vector<std::string>> rows{{"label", "transceiver", "measured", "expected", "residual"}};
  for (std::size_t k = 0; k < std::min(pairs.size(), listed); ++k) {
    const ComparedPair& pair = input.pairs[pairs[k]];
    const PairResult& result = input.comparison.pairs[pairs[k]];
    rows.push_back({input.matrix.labels[pair.label].id,
                    pair.transceiver ? input.matrix.transceivers[*pair.transceiver].id : "all",
                    words.significant(pair.measured), words.significant(result.expected),
                    result.residual ? words.decibels(*result.residual) : "-"});
  }
  print_table(rows, 2);
}

void print_text(const ComparisonInput& input, const Outputs& outputs) {
  const std::vector<std::string> statements = comparison_statements(english(), input.comparison);
  for (const std::string& statement : statements)
    fmt::print("{}\n", &statement == &statements.front() ? styled(Style::answer, statement) : statement);
  if (!outputs.page.empty()) fmt::print("report: {}\n", outputs.page.string());
  if (!outputs.table.empty()) fmt::print("table: {}\n", outputs.table.string());
  const Comparison& c = input.comparison;
  if (c.outliers.empty())
    fmt::print("No pair is an outlier.\n");
  else
    print_pairs(input,
                c.outliers.size() > listed
                    ? fmt::format("{}, the first {}:", counted(c.outliers.size(), "outlier"), listed)
                    : counted(c.outliers.size(), "outlier") + ":",
                c.outliers);
  print_pairs(input, fmt::format("{}:", worst_pairs_heading(english(), c)), c.worst);
}

int run_compare(const CompareArguments& options) {
  const Outputs outputs = outputs_of(options);
  const SignalMatrix matrix = read_signal_file(options.signal);
  const Measurements measurements = read_measurements(options.measured, matrix);
  const std::vector<ComparedPair> pairs =
      compared_pairs(matrix, measurements, units_of(options, matrix, measurements));
  const Comparison comparison = compare_signals(pairs, options.confidence, options.measured.string());
  const ComparisonInput input{matrix,
                              pairs,
                              comparison,
                              options.measured.filename().string(),
                              options.signal.filename().string(),
                              options.safe_csv};
  prepare(options, outputs);
  if (!outputs.table.empty()) write_file(outputs.table, comparison_csv(input));
  if (!outputs.page.empty()) write_file(outputs.page, comparison_html(english(), input));
  if (options.common.json) {
    nlohmann::ordered_json json = comparison_json(input, listed);
    if (!outputs.table.empty()) json["table"] = outputs.table.string();
    if (!outputs.page.empty()) json["report"] = outputs.page.string();
    print_json(json);
  } else if (!options.common.quiet) {
    print_text(input, outputs);
  }
  return done;
}

}  // namespace

void add_compare(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("compare", "Compare measured with simulated signals ('diff' is for plans)");
  auto options = std::make_shared<CompareArguments>();
  const OptionGroup first(*verb);
  first.require("SIGNAL", options->signal, a_path(), "Signal file (HDF5, from trusted sources only)");
  first.require("MEASURED", options->measured, a_path(),
                "CSV with columns label,transceiver,signal or label,signal, and optionally error");
  first.add("--placement", options->placement, a_path(),
            "placement.json of the units that were on together, for measurements without a transceiver");
  first.add("--confidence", options->confidence, a_share("LEVEL", {0.5, 0.9999, true, true}),
            fmt::format("Confidence of the intervals, e.g. 0.99 or 99%; default {}", options->confidence));
  first.add("-o,--output", options->output, a_path(),
            "Folder for comparison.csv and comparison.html, or a file .csv or .html");
  add_safe_csv(*verb, options->safe_csv)->needs("--output");
  finish_verb(*verb, chosen, options, run_compare,
              "Examples:\n"
              "  shelfbeam compare plan/signal.h5 measured.csv -o comparison\n"
              "  shelfbeam compare plan/signal.h5 labels.csv --placement plan/placement.json\n"
              "To show what changed between two plans, use 'shelfbeam diff'.");
}

}  // namespace shelfbeam::app
