#include "shelfbeam/placement/mip/mip.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

// Relative gap at which the search ends (the MIP's own gap).
constexpr double proof_gap = 1e-6;

bool closes(double bound, double value) {
  return std::isfinite(value) && value - bound <= proof_gap * value;
}

/// Improves the incumbent in the order of the problem's objectives.
struct Search {
  const detail::Instance& instance;
  detail::CoverModel& model;
  Selection selected = {};
  double count = milp::infinity;  ///< infinite without a selection
  double value = milp::infinity;  ///< second objective (lexicographic) or whole sum (weighted)

  void offer(const std::optional<Selection>& candidate) {
    if (!candidate) return;
    const bool is_weighted = instance.is_weighted();
    const Check check = instance.check(*candidate);
    const double new_value = check.objective + (is_weighted ? check.transceiver_cost : 0);
    const auto new_count = static_cast<double>(candidate->size());
    const bool better =
        is_weighted ? new_value < value : std::pair(new_count, new_value) < std::pair(count, value);
    if (!better) return;
    selected = *candidate;
    count = new_count;
    value = new_value;
  }

  /// Minimises the count; then, if it is proven, the second objective at that count.
  MipResult lexicographic() {
    MipResult answer;
    const std::vector<double>& ones = instance.first_cost;
    const auto fewest = model.minimise({.cost = ones, .known = count});
    if (fewest.infeasible) return {infeasible_placement()};
    offer(fewest.selected);
    answer.solver_failed = fewest.failed;
    const double proven_count = std::clamp(instance.bounds.rounded(fewest.bound),
                                           static_cast<double>(instance.trivial_count_bound()), count);
    answer.placement.count_lower_bound = proven_count;
    const bool is_fewest = std::isfinite(count) && proven_count == count;
    if (instance.problem.objective == Objective::count) {
      set_value(answer.placement, count, proven_count, is_fewest);
      return answer;
    }

    const std::vector<double>& cost = instance.second_cost;
    const CostBounds& bounds = instance.second_bounds;
    double bound = bounds.cheapest(static_cast<std::size_t>(proven_count));
    bool is_optimal = is_fewest && closes(bound, value);
    if (is_fewest && !is_optimal) {
      const auto units = static_cast<std::size_t>(count);
      const auto best =
          model.minimise({.cost = cost, .known = value, .min_count = units, .max_count = units});
      offer(best.selected);
      answer.solver_failed = answer.solver_failed || best.failed;
      bound = std::max(bound, bounds.rounded(best.bound));
      is_optimal = best.proven || closes(bound, value);
    }
    set_value(answer.placement, value, bound, is_optimal);
    return answer;
  }

  MipResult weighted() {
    MipResult answer;
    const std::vector<double>& cost = instance.first_cost;
    const CostBounds& bounds = instance.bounds;
    const std::size_t min_count = instance.trivial_count_bound();
    double bound = bounds.cheapest(min_count);
    bool is_optimal = closes(bound, value);
    if (!is_optimal) {
      const auto best = model.minimise({.cost = cost, .known = value});
      if (best.infeasible) return {infeasible_placement()};
      offer(best.selected);
      answer.solver_failed = best.failed;
      bound = std::max(bound, bounds.rounded(best.bound));
      is_optimal = best.proven || closes(bound, value);
    }
    set_value(answer.placement, value, bound, is_optimal);
    answer.placement.count_lower_bound =
        static_cast<double>(std::max(min_count, bounds.fewest(answer.placement.lower_bound)));
    return answer;
  }

  // The bound may exceed the value only by rounding.
  static void set_value(Placement& placement, double value, double bound, bool is_optimal) {
    placement.objective_value = value;
    placement.lower_bound = std::min(bound, value);
    placement.status = is_optimal ? Status::optimal : Status::stopped;
  }
};

}  // namespace

MipResult place_by_mip(const detail::Instance& instance, const std::optional<Selection>& start,
                       const SolveFunction& solve, const detail::Effort& effort, const RunControl& control,
                       const MipKnowledge& knowledge) {
  detail::CoverModel model(instance, solve, effort, control, knowledge);
  Search search{instance, model};
  search.offer(start);
  MipResult answer =
      instance.problem.combination == Combination::lexicographic ? search.lexicographic() : search.weighted();
  answer.placement.selected = search.selected;
  return answer;
}

}  // namespace shelfbeam
