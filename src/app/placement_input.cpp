#include "placement_input.hpp"

#include <string>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/signal/apart.hpp"
#include "shelfbeam/signal/stack_tables.hpp"

#include "arguments.hpp"

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
  for (const auto& file : costs) keep_input(output, file);
  for (const auto& file : forbidden) keep_input(output, file);
}

SignalTable PlacementInput::table(const Question& question) const {
  std::vector<NamedTable> scenarios;
  for (const auto& file : signals)
    scenarios.push_back({file.stem().string(), file.string(), read_signal_table(file)});
  SignalTable table = stack_tables(std::move(scenarios));
  const std::string name = names_of(signals);
  if (threshold > 0) set_requirement(table, threshold);
  for (const auto& file : costs) apply_costs(table, file);
  for (const auto& file : forbidden) forbid_pairs(table, file);
  if (min_spacing > 0) keep_apart(table, min_spacing, name);
  try {
    check_question(table, question);
  } catch (const InputError& error) {
    throw InputError(name, error.what());
  }
  return table;
}

void add_placement_input(CLI::App& verb, PlacementInput& input) {
  verb.add_option("SIGNAL", input.signals,
                  "Signal file (HDF5), CSV, NPY, sparse text, or OR-Library scp or rail file; several are "
                  "scenarios for one placement")
      ->required()
      ->check(a_path());
  verb.add_option("--threshold", input.threshold,
                  "Requirement of every label: for matrices without one, or instead of the file's")
      ->check(positive_number());
  verb.add_option("--costs", input.costs,
                  "CSV 'id,cost' of transceivers or 'id,link_cost,signal_cost' of labels; may be repeated")
      ->allow_extra_args(false)
      ->check(a_path());
  verb.add_option("--min-spacing", input.min_spacing,
                  "Choose no two transceivers closer than this, m (installed ones stay where they are)")
      ->check(positive_number());
  verb.add_option("--forbid", input.forbidden,
                  "CSV 'a,b' of transceivers that must not be chosen together; may be repeated")
      ->allow_extra_args(false)
      ->check(a_path());
}

}  // namespace shelfbeam::app
