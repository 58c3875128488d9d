#include "app/options/placement_input.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/signal/constraints/stack_tables.hpp"
#include "shelfbeam/signal/tables/formats.hpp"

#include "app/options/arguments.hpp"
#include "app/options/scenario_names.hpp"

namespace shelfbeam::app {

namespace {

std::string names_of(const std::vector<std::filesystem::path>& files) {
  std::string names;
  for (const auto& file : files) names += (names.empty() ? "" : ", ") + file.string();
  return names;
}

}  // namespace

void PlacementInput::keep(const std::filesystem::path& output) const {
  for (const auto& file : signals) keep_input(output, file);
  requirements.keep(output);
}

SignalTable PlacementInput::table(const Question& question) const {
  const std::vector<std::string> scenario = scenario_names(signals);
  std::vector<NamedTable> scenarios;
  for (std::size_t k = 0; k < signals.size(); ++k)
    scenarios.push_back({scenario[k], signals[k].string(), read_signal_table(signals[k])});
  SignalTable table = stack_tables(std::move(scenarios));
  const std::string name = names_of(signals);
  if (threshold > 0) set_requirement(table, threshold);
  requirements.apply(table, name);
  try {
    check_question(table, question);
  } catch (const InputError& error) {
    throw InputError(name, error.what(), {}, error.setting());
  }
  return table;
}

void add_placement_input(CLI::App& verb, PlacementInput& input) {
  verb.add_option("SIGNAL", input.signals,
                  fmt::format("Signal file (HDF5; not safe to open if a stranger made it), {}; several are "
                              "scenarios for one placement",
                              detail::matrix_formats))
      ->required()
      ->check(a_path());
  verb.add_option("--threshold", input.threshold,
                  "Requirement of every label: for matrices without one, or instead of the file's")
      ->check(positive_number());
  add_requirement_options(verb, input.requirements);
}

}  // namespace shelfbeam::app
