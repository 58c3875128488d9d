#include "shelfbeam/placement/coverage/fewest_units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"
#include "shelfbeam/placement/coverage/least_useful.hpp"
#include "shelfbeam/placement/coverage/partial_search.hpp"

namespace shelfbeam {

namespace {

using detail::Effort;

constexpr double infinity = std::numeric_limits<double>::infinity();

class Minimisation final : detail::PartialSearch {
 public:
  Minimisation(const detail::Instance& instance, double share, const PlaceOptions& options,
               const RunControl& control)
      : PartialSearch(instance, options, control),
        share_(share),
        max_units_(instance.table.mounting_points()),
        target_(weights_.rounded_up(share * weights_.total())),
        upper_bound_(detail::reachable_weight(instance, weights_)) {
    Minimisation::offer(instance.installed);
    const std::size_t installed = instance.installed.size();
    raise_to(target_ <= 0 || incumbent_.has_selection() ? installed
             : upper_bound_ < target_
                 ? max_units_ + 1
                 : std::max<std::size_t>(installed + 1, instance.problem.redundant ? 2 : 1),
             BoundProof::trivial);
    if (!options.start.empty()) Minimisation::offer(options.start);
  }

  FewestUnits run() {
    search();
    FewestUnits answer;
    fill(answer);
    answer.has_selection = incumbent_.has_selection();
    answer.share = share_;
    answer.target = weights_.in_table(target_);
    if (incumbent_.is_closed() && !answer.has_selection) {
      answer.status = Status::infeasible;
      upper_bound_ = std::min(upper_bound_, std::max(0.0, target_ - weights_.step()));
    } else {
      answer.count_lower_bound = count_bound();
    }
    const double reached = answer.has_selection ? weights_.without(answer.missed) : 0;
    answer.weight = {weights_.in_table(reached), weights_.in_table(weights_.total()),
                     weights_.in_table(upper_bound_)};
    return answer;
  }

 private:
  std::size_t count_bound() const { return static_cast<std::size_t>(incumbent_.bound()); }
  std::uint64_t long_walk() const override { return 20'000'000; }

  void offer(const Selection& selected) override {
    const Check check = instance_.check(selected);
    if (check.allowed() && weights_.without(check.unmet) >= target_)
      incumbent_.offer(selected, static_cast<double>(selected.size()));
  }

  // More than all mounting points can hold do not exist.
  double existing(double count) const {
    return !incumbent_.has_selection() && count > static_cast<double>(max_units_) ? infinity : count;
  }
  void raise_to(std::size_t count, BoundProof proof) {
    incumbent_.raise(existing(static_cast<double>(count)), proof, step);
  }

  // The fewest units with which the greedy selection begins and that reach the target.
  void begin(const Effort& effort) override {
    std::size_t too_few = 0, enough = order_.size();
    while (too_few + 1 < enough) {
      const std::size_t middle = too_few + (enough - too_few) / 2;
      const double reached = detail::weight_of(instance_, weights_, detail::first_units(order_, middle));
      (reached >= target_ ? enough : too_few) = middle;
    }
    first_ = detail::without_useless(instance_, weights_, detail::first_units(order_, enough),
                                     {.until = effort.until}, control_);
    offer(first_);
  }

  // For fewer units, or for any selection if none is known.
  bool anneal(const detail::CoverageAnnealing& annealing, const Effort& effort, std::uint32_t seed) override {
    const Selection& start = incumbent_.has_selection() ? incumbent_.selected() : first_;
    if (!instance_.can_exchange(start)) return false;
    if (const auto found = annealing.for_fewer(target_, start, effort, seed, control_)) {
      offer(*found);
      solver_ = {Method::search};
    }
    return true;
  }

  void raise_by_multipliers(const Effort& effort) override {
    // With unit failure, the bound is better for fewer units.
    CoverageBound bound_for(instance_, weights_,
                            incumbent_.has_selection() ? incumbent_.selected().size() - 1 : max_units_);
    Effort left = detail::bound_effort(bound_for.entries(), effort, instance_.table);
    while (!incumbent_.is_closed()) {
      left.steps -=
          bound_for.improve(count_bound(), target_ - weights_.step(), CoverageAim::reached, left, control_);
      if (bound_for.weight(count_bound()) >= target_) return;
      raise_to(count_bound() + 1, BoundProof::dual);
    }
  }

  void raise_by_enumeration(const Effort& effort) override {
    detail::CoverageTable table(instance_, weights_);
    Effort left = detail::enumeration_effort(effort, instance_.table);
    while (!incumbent_.is_closed()) {
      const auto found = enumerate_coverage(table, weights_, count_bound(), target_,
                                            detail::EnumerationAim::first, left, control_);
      if (!found.is_complete) return;
      if (found.selected) {
        solver_ = {Method::search};
        return offer(*found.selected);
      }
      const auto strength =
          judged(instance_, weights_, found.proof, count_bound(), target_, {.until = effort.until}, control_);
      if (!strength) return;
      solver_ = {Method::search};
      raise_to(count_bound() + 1, *strength);
    }
  }

  // Half a step keeps the row of misses valid in spite of the solver's tolerance.
  MipQuestion mip_question() const override {
    return {{.cost = instance_.first_cost, .max_missed = weights_.total() - target_ + weights_.step() / 2},
            incumbent_.has_selection() ? incumbent_.value() - 0.5 : milp::infinity,
            [this](const detail::CoverModel::Outcome& outcome) {
              if (outcome.infeasible && !incumbent_.has_selection()) return infinity;
              return existing(std::ceil(outcome.bound - 1e-6));
            }};
  }

  double share_;
  std::size_t max_units_;
  double target_, upper_bound_;
  Selection first_;  ///< of the greedy method
};

}  // namespace

FewestUnits fewest_units(const SignalTable& table, const PlacementProblem& problem, double share,
                         const PlaceOptions& options, const RunControl& control) {
  return detail::search_partial(table, problem, options, control, [&](const detail::Instance& instance) {
    return Minimisation(instance, share, options, control).run();
  });
}

}  // namespace shelfbeam
