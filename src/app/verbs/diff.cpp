#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/plan/difference/plan_difference.hpp"
#include "shelfbeam/report/data/label_names.hpp"
#include "shelfbeam/report/difference/difference_json.hpp"
#include "shelfbeam/report/difference/difference_report.hpp"
#include "shelfbeam/report/messages/difference.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "app/options/arguments.hpp"
#include "app/text/style.hpp"
#include "app/text/terminal.hpp"
#include "app/verbs.hpp"
#include "jobs/plan_folder.hpp"
#include "jobs/stored_plan.hpp"

namespace shelfbeam::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t listed_labels = 5;  // labels of a kind in the text

struct DiffArguments {
  CommonOptions common;
  fs::path before, after, output;
};

/// The folder of a plan, which may be given by its placement.json.
fs::path folder_of(const fs::path& plan) {
  if (fs::is_directory(plan)) {
    if (fs::exists(plan / jobs::placement_name)) return plan;
    throw InputError((plan / jobs::placement_name).string(),
                     "does not exist, so the folder contains no finished plan",
                     "name a folder that 'shelfbeam plan' wrote");
  }
  if (plan.filename() == jobs::placement_name && fs::exists(plan))
    return plan.has_parent_path() ? plan.parent_path() : ".";
  throw InputError(plan.string(), fs::exists(plan) ? "is not the folder of a plan" : "does not exist",
                   "name a folder that 'shelfbeam plan' wrote, or its placement.json");
}

struct PlanToCompare {
  Scene scene;
  SignalMatrix rows;  ///< of labels alone
  ComparedPlan plan;

  void name_labels(const Words& words) { plan.label_names = LabelNames(scene, rows, words).all(); }
};

/// The signal matrix, by far the largest part, is not kept.
PlanToCompare read_plan_of(const fs::path& folder) {
  jobs::StoredPlan stored = jobs::read_stored_plan(folder);
  std::string store = resolved_store_json(stored.store, stored.scene);
  SignalMatrix rows;
  rows.labels = stored.matrix.labels;
  ComparedPlan plan = compared_plan(stored.matrix, std::move(stored.plan), std::move(store));
  return {std::move(stored.scene), std::move(rows), std::move(plan)};
}

void prepare_page(const DiffArguments& options, const fs::path& before, const fs::path& after) {
  if (options.output.empty()) return;
  if (options.output.extension() != ".html")
    throw InputError(options.output.string(), "is not the name of a page", "use the extension .html");
  for (const fs::path& folder : {before, after})
    for (const char* name : jobs::plan_file_names) protect_input(options.output, folder / name);
  expect_writable(options.output);
}

/// The names of two folders: their last parts if these tell them apart.
std::pair<std::string, std::string> names_of(const fs::path& before, const fs::path& after) {
  const auto last = [](const fs::path& folder) {
    return fs::absolute(folder / ".").lexically_normal().parent_path();
  };
  const fs::path a = last(before), b = last(after);
  if (a.parent_path() == b.parent_path()) return {a.filename().string(), b.filename().string()};
  return {before.string(), after.string()};
}

void print_rows(const std::string& heading, const TextTable& rows, std::size_t left) {
  if (rows.size() < 2) return;
  if (!heading.empty()) fmt::print("{}\n", heading);
  print_table(rows, left);
}

void print_difference(const DiffArguments& options, const DifferenceInput& input) {
  const Words words = english();
  const PlanDifference& difference = input.difference;
  fmt::print("{}\n", styled(Style::answer, difference_answer(words, input)));
  if (!options.output.empty()) fmt::print("report: {}\n", options.output.string());
  if (difference.is_empty()) return;
  print_rows({}, difference_figures(words, input), 3);
  print_rows(words.say("difference.units_heading", unit_counts(words, difference)),
             changed_units(words, input), 5);
  for (const LabelChange change : listed_changes)
    print_rows(labels_heading(words, change, difference.count(change), listed_labels) + ":",
               changed_labels(words, input, change, listed_labels), 1);
  print_rows(words.say("difference.section.weakest") + ":", weakest_labels(words, input), 1);
  fmt::print("{}\n", difference.store.empty() ? words.say("difference.section.no_store")
                                              : words.say("difference.section.store") + ":");
  for (const std::string& line : store_lines(words, difference)) fmt::print("  {}\n", line);
}

int run_diff(const DiffArguments& options) {
  const fs::path before = folder_of(options.before), after = folder_of(options.after);
  prepare_page(options, before, after);
  PlanToCompare first = read_plan_of(before), second = read_plan_of(after);
  const PlanDifference difference = difference_of(first.plan, second.plan);
  const DifferenceInput input{first.plan, second.plan, difference};
  const auto name_labels = [&](const Words& words) {
    first.name_labels(words);
    second.name_labels(words);
  };
  if (!options.output.empty()) {
    name_labels(words_of(second.scene));
    const auto [first_name, second_name] = names_of(before, after);
    write_file(options.output, difference_html({input, second.scene, first_name, second_name}));
  }
  if (options.common.json || !options.common.quiet) name_labels(english());
  if (options.common.json) {
    nlohmann::ordered_json json = difference_json(input);
    if (!options.output.empty()) json["report"] = options.output.string();
    print_json(json);
  } else if (!options.common.quiet) {
    print_difference(options, input);
  }
  return done;
}

}  // namespace

void add_diff(CLI::App& app, ChosenVerb& chosen) {
  CLI::App* verb =
      app.add_subcommand("diff", "Show what changed between two plans ('compare' is for signals)");
  auto options = std::make_shared<DiffArguments>();
  const OptionGroup first(*verb);
  first.require("PLAN1", options->before, a_path(),
                "Folder written by 'shelfbeam plan', from a trusted source (HDF5)");
  first.require("PLAN2", options->after, a_path(), "Folder of the plan to compare with it");
  first.add("-o,--output", options->output, a_path(), "Write a page with a floor plan to this .html file");
  finish_verb(*verb, chosen, options, run_diff,
              "Examples:\n"
              "  shelfbeam diff plan plan-after\n"
              "  shelfbeam diff plan plan-after -o diff.html\n"
              "To compare a plan with measured signals, use 'shelfbeam compare'.");
}

}  // namespace shelfbeam::app
