#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::app {

/// What is asked of a placement beside its matrix: prices, and which candidates must not be chosen together.
struct Requirements {
  std::vector<std::filesystem::path> costs;
  double min_spacing = 0;  ///< m; 0: not given
  std::vector<std::filesystem::path> forbidden;

  /// Throws InputError when the output is one of the files that are read.
  void keep(const std::filesystem::path& output) const;
  /// `name` stands for the matrix in errors.
  void apply(SignalTable& table, const std::string& name) const;
};

void add_requirement_options(CLI::App& verb, Requirements& requirements);

}  // namespace shelfbeam::app
