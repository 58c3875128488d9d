#include "shelfbeam/plan/question/partial_question.hpp"

#include <limits>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/coverage/fewest_units.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

Placement with_bounds(MaxCoverage reach) {
  Placement placement;
  placement.partial = {ReachGoal::at_most, static_cast<double>(reach.at_most), reach.reached,
                       reach.upper_bound};
  placement.status = reach.status;
  placement.selected = std::move(reach.selected);
  placement.bound_proof = reach.bound_proof;
  placement.solver = std::move(reach.solver);
  placement.seconds = reach.seconds;
  return placement;
}

Placement with_bounds(FewestUnits fewest) {
  Placement placement;
  placement.partial = {ReachGoal::share, fewest.share, fewest.reached,
                       static_cast<std::size_t>(fewest.weight.upper_bound)};
  placement.status = fewest.status;
  placement.selected = std::move(fewest.selected);
  placement.count_lower_bound = static_cast<double>(fewest.count_lower_bound);
  placement.bound_proof = fewest.bound_proof;
  placement.solver = std::move(fewest.solver);
  placement.seconds = fewest.seconds;
  return placement;
}

Placement with_bounds(const SignalTable& table, const PlacementProblem& problem, const Selection& given) {
  Placement placement;
  const std::size_t missed = check_selection(table, problem, given).unmet.size();
  placement.partial = {ReachGoal::given, static_cast<double>(given.size()), table.rows() - missed,
                       table.rows()};
  placement.status = Status::feasible;
  placement.selected = given;
  return placement;
}

}  // namespace

void check_question(const PartialQuestion& question, const PlacementProblem& problem) {
  if (question.at_most && question.share)
    throw InputError("a number of units", "excludes a share of the labels", "ask for one of the two",
                     Setting::units);
  if (!question.is_asked() || question.given) return;
  if (problem.objective == Objective::count && problem.combination != Combination::weighted) return;
  if (question.share)
    throw InputError("a share of the labels", "is reached with the fewest units, without objectives or costs",
                     "remove the objective and the sum of costs", Setting::share_of_labels);
  throw InputError("a number of units", "reaches the most labels, without objectives or costs",
                   "remove the objective and the sum of costs", Setting::units);
}

Placement place_partially(const SignalTable& table, const PlacementProblem& problem,
                          const PartialQuestion& question, const PlaceOptions& options,
                          const RunControl& control) {
  PlacementProblem counting = problem;
  counting.objective = Objective::count;
  counting.combination = Combination::lexicographic;
  Placement placement =
      question.given   ? with_bounds(table, counting, *question.given)
      : question.share ? with_bounds(fewest_units(table, counting, *question.share, options, control))
                       : with_bounds(maximise_coverage(table, counting, *question.at_most, options, control));
  placement.problem = counting;
  const bool is_found = !placement.selected.empty() || placement.status == Status::optimal;
  placement.objective_value =
      is_found ? static_cast<double>(placement.count()) : std::numeric_limits<double>::infinity();
  placement.lower_bound = placement.count_lower_bound;
  placement.min_spacing = table.min_spacing;
  placement.forbidden_pairs = table.conflicts.size();
  if (is_found && has_prices(table)) placement.price = price_of(table, placement.selected);
  return placement;
}

}  // namespace shelfbeam
