#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "app/text/placement_text.hpp"

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

/// The options that choose the placement question; `place`, `plan` and `export` take them.
void add_question_options(CLI::App& verb, Question& question);

/// How the question is answered; `place` and `plan` take them.
void add_solver_options(CLI::App& verb, PlaceOptions& options);

/// How sure a certificate must be, and what it may take; `plan` and `verify` take them.
struct CertificateFlags {
  double confidence = 0.99;
  double budget_s = 600;
};

void add_certificate_options(CLI::App& verb, CertificateFlags& flags);

/// done, answer_is_no or stopped_early.
int exit_code(Status status);

}  // namespace shelfbeam::app
