#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/plan/question/partial_question.hpp"
#include "shelfbeam/signal/constraints/table_constraints.hpp"
#include "shelfbeam/transport/run/simulation_request.hpp"

namespace shelfbeam {

/// The plan that a user asks for, of a fixed or a changing shop. Together with the store file it determines
/// the result, except where time limits decide.
struct PlanRequest {
  std::uint64_t seed = 1;
  SimulationRequest simulation = {};
  PlacementProblem problem = {.combination = Combination::automatic};
  PartialQuestion partial = {};  ///< instead of a selection that reaches all labels
  PlaceOptions place = {};
  TableConstraints constraints = {};
  bool certifies = true;
  double confidence = 0.99;  ///< of the certificate, and of the sensitivity
  double budget_s = 600;     ///< of the certificate
  bool curve = false;        ///< labels that fewer transceivers can reach
  bool alternatives = true;  ///< selections with one unit fewer, one more, and for the failure of any
  /// Relative error of reflectances without a given range: examines the sensitivity.
  std::optional<double> reflectance_error = {};
  /// States on which units are placed; 0: the shop as the file gives it. Default: StatesOptions::sample if
  /// the store has a variation.
  std::optional<std::uint32_t> states = {};
  AvailabilityGoal goal = {};

  /// Whether the certificate decides how many samples are taken where.
  bool follows_decision() const {
    return certifies && !partial.is_asked() && !simulation.samples && !simulation.relative_error &&
           !simulation.time_s;
  }
};

}  // namespace shelfbeam
