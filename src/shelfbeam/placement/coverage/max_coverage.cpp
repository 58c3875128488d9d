#include "shelfbeam/placement/coverage/max_coverage.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
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

using detail::EnumerationAim;

// MIP solvers prove optima within a part in 1e6.
constexpr double solver_gap = 2e-6;

class Maximisation {
 public:
  Maximisation(const detail::Instance& instance, const PlacementProblem& asked, std::size_t units,
               const PlaceOptions& options, const RunControl& control)
      : instance_(instance),
        options_(options),
        control_(control),
        units_(std::min(units, instance.columns())),
        weights_(instance.table) {
    reach_.problem = asked;
    reach_.problem.combination = Combination::lexicographic;
    reach_.at_most = units;
    reach_.solver = {Method::greedy};
    reach_.selected = instance.installed;
    reach_.missed = instance.check(reach_.selected).unmet;
    value_ = weights_.without(reach_.missed);
    if (!options.start.empty()) offer(options.start);
    bound_ = weights_.total();
  }

  MaxCoverage run() {
    detail::CoverageRun run = detail::CoverageSchedule(*this, instance_, options_, control_).run();
    reach_.steps = std::move(run.steps);
    reach_.too_large = run.too_large;
    if (bound_ >= weights_.total())  // no time for more
      lower_to(detail::reachable_weight(instance_, weights_), BoundProof::trivial);
    reach_.status = is_proven() ? Status::optimal : run.is_cut_short ? Status::stopped : Status::feasible;
    reach_.reached = instance_.rows() - reach_.missed.size();
    if (!has_weights(instance_.table)) {
      reach_.upper_bound = static_cast<std::size_t>(bound_);
      return std::move(reach_);
    }
    const std::vector<bool> can = detail::reachable_labels(instance_);
    reach_.upper_bound = static_cast<std::size_t>(std::count(can.begin(), can.end(), true));
    reach_.weight = CoverageWeight{weights_.in_table(value_), weights_.in_table(weights_.total()),
                                   weights_.in_table(std::max(bound_, value_))};
    return std::move(reach_);
  }

  static constexpr std::uint64_t long_walk = 4'000'000;

  const detail::LabelWeights& weights() const { return weights_; }
  const Selection& selected() const { return reach_.selected; }
  double value() const { return weights_.in_table(value_); }
  double bound() const { return weights_.in_table(bound_); }
  bool is_proven() const {
    return bound_ <= value_ + (weights_.are_whole() ? 0 : weights_.step()) || is_closed_by_solver_;
  }
  bool may_improve() const { return !is_proven(); }
  bool is_settled() const { return is_settled_; }

  /// The units that a greedy selection of all labels adds first.
  void begin(const detail::Effort& effort) {
    order_ = greedy_order(instance_, weights_.of_labels(), {.until = effort.until}, control_);
    offer_compact(detail::first_units(order_, units_), effort);
  }

  /// For more weight.
  bool anneal(const detail::CoverageAnnealing& annealing, const detail::Effort& effort, std::uint32_t seed) {
    const Selection start = filled();
    if (!instance_.can_exchange(start)) return false;
    const auto found = annealing.for_more(value_, start, effort, seed, control_);
    if (!found) return true;
    offer_compact(*found, effort);
    reach_.solver = {Method::search};
    return true;
  }

  void raise_by_multipliers(const detail::Effort& effort) {
    CoverageBound bound(instance_, weights_, units_);
    bound_ = bound.weight(units_);
    bound.improve(units_, value_, CoverageAim::lowest,
                  {detail::bound_steps(bound.entries(), effort, instance_.table), effort.until}, control_);
    lower_to(bound.weight(units_), BoundProof::dual);
  }

  void raise_by_enumeration(const detail::Effort& effort) { is_settled_ = enumerate(effort); }

  // Whole weights: a unit of missed weight costs more than all units together, so the missed weight is
  // minimised first and units second. Units cost nothing if they are not.
  void solve(const detail::Effort& effort) {
    const bool are_whole = weights_.are_whole();
    const double unit_price = are_whole ? 1 : 0;
    const double price = are_whole ? static_cast<double>(instance_.columns() + 1) : 1;
    const std::vector<double> cost(instance_.columns(), unit_price);
    for (const milp::Backend& backend : milp::backends_of(options_.backend)) {
      const double known =
          unit_price * static_cast<double>(reach_.selected.size()) + price * (weights_.total() - value_);
      detail::CoverModel model(instance_, backend.solve, effort, control_, {.cutoff = known - unit_price / 2},
                               weights_.of_labels());
      const auto outcome = model.minimise({.cost = cost, .max_count = units_, .price_of_misses = price});
      reach_.solver = {Method::mip, backend.full_name()};
      if (outcome.selected) offer(*outcome.selected);
      // A bound d on count + price missed, with count <= units < price, proves missed >= (d - units) / price.
      const double least = (outcome.bound - unit_price * static_cast<double>(units_)) / price;
      const double missed = are_whole ? std::ceil(least - 1e-6) : least * (1 - 1e-9);
      const double bound = weights_.total() - std::clamp(missed, 0.0, weights_.total());
      const double allowed = are_whole ? 0 : solver_gap * weights_.total();
      const bool contradicts = bound < value_ - allowed;
      if (!contradicts) lower_to(std::max(bound, value_), BoundProof::solver);
      if (!contradicts && !are_whole && bound <= value_ + allowed) {
        is_closed_by_solver_ = true;
        reach_.bound_proof = BoundProof::solver;
      }
      if (!outcome.failed && !contradicts) break;
    }
  }

 private:
  /// Accepts a selection that is better than the incumbent.
  void offer(const Selection& selected) {
    Check check = instance_.check(selected);
    const double value = weights_.without(check.unmet);
    const bool better = value > value_ || (value == value_ && selected.size() < reach_.selected.size());
    if (!check.allowed() || selected.size() > reach_.at_most || !better) return;
    reach_.selected = selected;
    reach_.missed = std::move(check.unmet);
    value_ = value;
  }

  void offer_compact(const Selection& selected, const detail::Effort& effort) {
    offer(detail::without_useless(instance_, weights_, selected, {.until = effort.until}, control_));
  }

  /// The incumbent, with further units of the greedy selection up to the allowed number.
  Selection filled() const {
    Selection result;
    std::vector<bool> is_out(instance_.columns(), false);
    const auto take = [&](std::uint32_t j) {
      if (is_out[j] || result.size() >= units_) return;
      result.push_back(j);
      is_out[j] = true;
      for (const ColumnId other : instance_.excludes[j]) is_out[other] = true;
    };
    std::for_each(reach_.selected.begin(), reach_.selected.end(), take);
    std::for_each(order_.begin(), order_.end(), take);
    std::sort(result.begin(), result.end());
    return result;
  }

  void lower_to(double bound, BoundProof proof) {
    if (bound >= bound_) return;
    bound_ = bound;
    reach_.bound_proof = proof;
  }

  /// Proves the value, then looks for fewer units of the same value; false if the work was not enough.
  bool enumerate(const detail::Effort& effort) {
    detail::CoverageTable table(instance_, weights_);
    detail::Effort left = detail::enumeration_effort(effort, instance_.table);
    const auto examine = [&](std::size_t units, double weight, EnumerationAim aim) {
      auto found = enumerate_coverage(table, weights_, units, weight, aim, left, control_);
      if (found.selected) offer(*found.selected);
      return found;
    };
    if (!is_proven()) {
      if (!examine(units_, value_ + weights_.step(), EnumerationAim::best).is_complete) return false;
      lower_to(value_, BoundProof::search);
      reach_.solver = {Method::search};
      offer_compact(reach_.selected, effort);
    }
    while (reach_.selected.size() > table.installed().size()) {
      const std::size_t size = reach_.selected.size();
      const auto fewer = examine(size - 1, value_, EnumerationAim::first);
      if (!fewer.is_complete) return reach_.bound_proof == BoundProof::search;
      if (reach_.selected.size() == size) break;
    }
    reach_.solver = {Method::search};
    return true;
  }

  const detail::Instance& instance_;
  const PlaceOptions& options_;
  const RunControl& control_;
  std::size_t units_;
  detail::LabelWeights weights_;
  std::vector<ColumnId> order_;  ///< of the greedy method
  MaxCoverage reach_;
  double value_ = 0, bound_ = 0;      ///< weights of the selection and of its upper bound
  bool is_closed_by_solver_ = false;  ///< within its gap, for weights that are not whole
  bool is_settled_ = false;           ///< no selection reaches more, or as much with fewer units
};

}  // namespace

MaxCoverage maximise_coverage(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                              const PlaceOptions& options, const RunControl& control) {
  return detail::search_partial(table, problem, options, control, [&](const detail::Instance& instance) {
    if (const std::size_t installed = instance.installed.size(); installed > units)
      throw InputError("number of units",
                       fmt::format("is {}, but {} units are installed or pinned", units, installed),
                       "use at least this number", Setting::units);
    return Maximisation(instance, problem, units, options, control).run();
  });
}

}  // namespace shelfbeam
