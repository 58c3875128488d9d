#include "placement_input.hpp"

#include <string>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/signal/apart.hpp"

#include "arguments.hpp"

namespace shelfbeam::app {

void PlacementInput::keep(const std::filesystem::path& output) const {
  keep_input(output, signal);
  for (const auto& file : costs) keep_input(output, file);
  for (const auto& file : forbidden) keep_input(output, file);
}

SignalTable PlacementInput::table(const Question& question) const {
  SignalTable table = read_signal_table(signal);
  if (threshold > 0) set_requirement(table, threshold);
  for (const auto& file : costs) apply_costs(table, file);
  for (const auto& file : forbidden) forbid_pairs(table, file);
  if (min_spacing > 0) keep_apart(table, min_spacing, signal.string());
  try {
    check_question(table, question);
  } catch (const InputError& error) {
    throw InputError(signal.string(), error.what());
  }
  return table;
}

void add_placement_input(CLI::App& verb, PlacementInput& input) {
  verb.add_option("SIGNAL", input.signal,
                  "Signal file (HDF5), CSV, NPY, sparse text, or OR-Library scp or rail file")
      ->required()
      ->check(a_path());
  verb.add_option("--threshold", input.threshold,
                  "Requirement of every label: for matrices without one, or instead of the file's")
      ->check(positive_number());
  verb.add_option("--costs", input.costs,
                  "CSV 'id,cost' of transceivers or 'id,link_cost,signal_cost' of labels; may be repeated")
      ->check(a_path());
  verb.add_option("--min-spacing", input.min_spacing,
                  "Choose no two transceivers closer than this, m (installed ones stay where they are)")
      ->check(positive_number());
  verb.add_option("--forbid", input.forbidden,
                  "CSV 'a,b' of transceivers that must not be chosen together; may be repeated")
      ->check(a_path());
}

}  // namespace shelfbeam::app
