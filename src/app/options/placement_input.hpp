#pragma once

#include <filesystem>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "app/options/requirements.hpp"

namespace shelfbeam::app {

/// Where `place` and `export` take their matrix from; several files are scenarios for one placement.
struct PlacementInput {
  std::vector<std::filesystem::path> signals;  ///< one a scenario
  double threshold = 0;                        ///< 0: not given
  Requirements requirements;

  /// Throws InputError when the output is one of the files that are read.
  void keep(const std::filesystem::path& output) const;
  /// Throws InputError that names the file, also where a label has no requirement.
  SignalTable table(const Question& question) const;
};

void add_placement_input(CLI::App& verb, PlacementInput& input);

}  // namespace shelfbeam::app
