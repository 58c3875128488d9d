#include "shelfbeam/placement/coverage/fewest_units.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/coverage/coverage_annealing.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_effort.hpp"
#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"
#include "shelfbeam/placement/coverage/coverage_run.hpp"
#include "shelfbeam/placement/coverage/least_useful.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

class Minimisation {
 public:
  Minimisation(const detail::Instance& instance, const PlacementProblem& asked, double share,
               const PlaceOptions& options, const RunControl& control)
      : instance_(instance),
        options_(options),
        control_(control),
        max_units_(instance.table.mounting_points()),
        weights_(instance.table),
        target_(weights_.rounded_up(share * weights_.total())) {
    result_.problem = asked;
    result_.problem.combination = Combination::lexicographic;
    result_.share = share;
    result_.target = weights_.in_table(target_);
    result_.solver = {Method::greedy};
    offer(instance.installed);
    result_.count_lower_bound = instance.installed.size();
    if (target_ > 0 && !result_.has_selection)
      result_.count_lower_bound =
          std::max(instance.installed.size() + 1, instance.problem.redundant ? std::size_t{2} : 1);
    if (!options.start.empty()) offer(options.start);
  }

  FewestUnits run() {
    upper_bound_ = detail::reachable_weight(instance_, weights_);
    is_infeasible_ =
        !result_.has_selection && (upper_bound_ < target_ || result_.count_lower_bound > max_units_);
    detail::CoverageRun run = detail::CoverageSchedule(*this, instance_, options_, control_).run();
    result_.steps = std::move(run.steps);
    result_.too_large = run.too_large;
    finish(run.is_cut_short);
    return std::move(result_);
  }

  static constexpr std::uint64_t long_walk = 20'000'000;

  const detail::LabelWeights& weights() const { return weights_; }
  const Selection& selected() const { return result_.selected; }
  double value() const {
    return result_.has_selection ? static_cast<double>(result_.selected.size())
                                 : std::numeric_limits<double>::infinity();
  }
  double bound() const { return static_cast<double>(result_.count_lower_bound); }
  bool may_improve() const { return !is_settled(); }
  bool is_settled() const {
    return is_infeasible_ || (result_.has_selection && result_.count_lower_bound >= result_.selected.size());
  }

  /// The fewest units with which a greedy selection of all labels begins and that reach the target.
  void begin(const detail::Effort& effort) {
    const auto order = greedy_order(instance_, weights_.of_labels(), {.until = effort.until}, control_);
    std::size_t too_few = 0, enough = order.size();
    while (too_few + 1 < enough) {
      const std::size_t middle = too_few + (enough - too_few) / 2;
      const double reached = detail::weight_of(instance_, weights_, detail::first_units(order, middle));
      (reached >= target_ ? enough : too_few) = middle;
    }
    first_ = detail::without_useless(instance_, weights_, detail::first_units(order, enough),
                                     {.until = effort.until}, control_);
    offer(first_);
  }

  /// For fewer units, or for any selection if none is known.
  bool anneal(const detail::CoverageAnnealing& annealing, const detail::Effort& effort, std::uint32_t seed) {
    const Selection& start = result_.has_selection ? result_.selected : first_;
    if (!instance_.can_exchange(start)) return false;
    const auto found = annealing.for_fewer(target_, start, effort, seed, control_);
    if (!found) return true;
    offer(*found);
    result_.solver = {Method::search};
    return true;
  }

  void raise_by_multipliers(const detail::Effort& effort) {
    // With unit failure, the bound is better for fewer units.
    const std::size_t max_count = result_.has_selection ? result_.selected.size() - 1 : max_units_;
    CoverageBound bound(instance_, weights_, max_count);
    detail::Effort left{detail::bound_steps(bound.entries(), effort, instance_.table), effort.until};
    while (!is_settled()) {
      const std::size_t count = result_.count_lower_bound;
      left.steps -= bound.improve(count, target_ - weights_.step(), CoverageAim::reached, left, control_);
      if (bound.weight(count) >= target_) return;
      raise_to(count + 1, BoundProof::dual);
    }
  }

  void raise_by_enumeration(const detail::Effort& effort) {
    detail::CoverageTable table(instance_, weights_);
    detail::Effort left = detail::enumeration_effort(effort, instance_.table);
    while (!is_settled()) {
      const std::size_t count = result_.count_lower_bound;
      const auto found =
          enumerate_coverage(table, weights_, count, target_, detail::EnumerationAim::first, left, control_);
      if (!found.is_complete) return;
      result_.solver = {Method::search};
      if (found.selected) {
        offer(*found.selected);
        return;
      }
      raise_to(count + 1, BoundProof::search);
    }
  }

  void solve(const detail::Effort& effort) {
    for (const milp::Backend& backend : milp::backends_of(options_.backend)) {
      const double cutoff =
          result_.has_selection ? static_cast<double>(result_.selected.size()) - 0.5 : milp::infinity;
      detail::CoverModel model(instance_, backend.solve, effort, control_, {.cutoff = cutoff},
                               weights_.of_labels());
      // Half a step keeps the row of misses valid in spite of the solver's tolerance.
      const auto outcome = model.minimise(
          {.cost = instance_.first_cost, .max_missed = weights_.total() - target_ + weights_.step() / 2});
      const double bound = std::ceil(outcome.bound - 1e-6);
      result_.solver = {Method::mip, backend.full_name()};
      if (outcome.selected) offer(*outcome.selected);
      // A solver that contradicts a checked selection is wrong.
      const bool contradicts = result_.has_selection && bound > static_cast<double>(result_.selected.size());
      if (!contradicts && bound > 0)
        raise_to(static_cast<std::size_t>(std::min(bound, static_cast<double>(max_units_ + 1))),
                 BoundProof::solver);
      if (!result_.has_selection && outcome.infeasible) {
        is_infeasible_ = true;
        result_.bound_proof = BoundProof::solver;
      }
      if (!outcome.failed && !contradicts) break;
    }
  }

 private:
  /// Accepts a selection that reaches the target with fewer units than the incumbent.
  void offer(const Selection& selected) {
    Check check = instance_.check(selected);
    const double weight = weights_.without(check.unmet);
    if (!check.allowed() || weight < target_ ||
        (result_.has_selection && selected.size() >= result_.selected.size()))
      return;
    result_.has_selection = true;
    result_.selected = selected;
    result_.missed = std::move(check.unmet);
    reached_ = weight;
  }

  void raise_to(std::size_t count, BoundProof proof) {
    if (count <= result_.count_lower_bound) return;
    result_.count_lower_bound = count;
    result_.bound_proof = proof;
    is_infeasible_ = !result_.has_selection && count > max_units_;
  }

  void finish(bool was_cut_short) {
    result_.status = is_infeasible_                            ? Status::infeasible
                     : is_settled()                            ? Status::optimal
                     : was_cut_short || !result_.has_selection ? Status::stopped
                                                               : Status::feasible;
    if (is_infeasible_) {
      upper_bound_ = std::min(upper_bound_, std::max(0.0, target_ - weights_.step()));
      result_.count_lower_bound = 0;
    }
    result_.reached = result_.has_selection ? instance_.rows() - result_.missed.size() : 0;
    result_.weight = {weights_.in_table(reached_), weights_.in_table(weights_.total()),
                      weights_.in_table(upper_bound_)};
  }

  const detail::Instance& instance_;
  const PlaceOptions& options_;
  const RunControl& control_;
  std::size_t max_units_;
  detail::LabelWeights weights_;
  double target_;
  FewestUnits result_;
  Selection first_;  ///< of the greedy method
  double reached_ = 0, upper_bound_ = 0;
  bool is_infeasible_ = false;
};

}  // namespace

FewestUnits fewest_units(const SignalTable& table, const PlacementProblem& problem, double share,
                         const PlaceOptions& options, const RunControl& control) {
  return detail::search_partial(table, problem, options, control, [&](const detail::Instance& instance) {
    return Minimisation(instance, problem, share, options, control).run();
  });
}

}  // namespace shelfbeam
