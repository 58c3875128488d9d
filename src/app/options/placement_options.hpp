#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/plan/question/partial_question.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"
#include "shelfbeam/scene/variation.hpp"
#include "shelfbeam/signal/constraints/table_constraints.hpp"
#include "shelfbeam/signal/constraints/unit_choice.hpp"
#include "shelfbeam/signal/tables/table_reading.hpp"

namespace shelfbeam::app {

/// Throws InputError if the output would overwrite a file of the constraints.
void protect_constraints(const std::filesystem::path& output, const TableConstraints& constraints);

void add_requirement_options(CLI::App& verb, TableConstraints& constraints);

/// The matrices of `place` and `export`; several files are scenarios of one placement.
struct PlacementInput {
  std::vector<std::filesystem::path> signals;  ///< one per scenario
  double threshold = 0;                        ///< 0: not given
  TableReading reading = TableReading::automatic;
  TableConstraints constraints;
  UnitChoice units;

  /// Throws InputError if the output would overwrite an input file.
  void keep(const std::filesystem::path& output) const;
  /// Throws InputError that names the file, also where a label has no requirement.
  ReadTable table(const PlacementProblem& problem) const;
};

void add_placement_input(CLI::App& verb, PlacementInput& input);

/// Pinned and excluded units, for `place`, `plan` and `export`.
void add_unit_options(CLI::App& verb, UnitChoice& units);

/// Most labels with few units, or fewest units for a share of the labels, for `place` and `plan`.
void add_partial_options(CLI::App& verb, PartialQuestion& question);

/// Options of the placement problem, for `place`, `plan` and `export`.
void add_problem_options(CLI::App& verb, PlacementProblem& problem);

/// Solver options, for `place` and `plan`.
void add_solver_options(CLI::App& verb, PlaceOptions& options);

/// Confidence and time limit of a certificate, for `plan` and `verify`.
void add_certificate_options(CLI::App& verb, double& confidence, double& budget_s);

/// Number of states, with its help text, and goal for a shop that changes.
void add_state_options(CLI::App& verb, std::optional<std::uint32_t>& states, const std::string& text,
                       AvailabilityGoal& goal);

/// --without.
void add_without(CLI::App& verb, std::vector<Cause>& without);

}  // namespace shelfbeam::app
