#include "shelfbeam/placement/coverage/max_coverage.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/coverage/coverage_bound.hpp"
#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"
#include "shelfbeam/placement/coverage/least_useful.hpp"
#include "shelfbeam/placement/coverage/partial_search.hpp"

namespace shelfbeam {

namespace {

using detail::Effort;
using detail::EnumerationAim;

/// The value is the missed weight.
class Maximisation final : detail::PartialSearch {
 public:
  Maximisation(const detail::Instance& instance, std::size_t units, const PlaceOptions& options,
               const RunControl& control)
      : PartialSearch(instance, options, control),
        at_most_(units),
        units_(std::min(units, instance.columns())),
        unit_cost_(instance.columns(), weights_.are_whole() ? 1 : 0) {
    incumbent_ = {weights_.are_whole() ? ValueSteps(1) : ValueSteps(0, weights_.step()), 0};
    incumbent_.replace(instance.installed, missed_by(instance.check(instance.installed)));
    if (!options.start.empty()) Maximisation::offer(options.start);
  }

  MaxCoverage run() {
    search();
    if (incumbent_.bound() <= 0)  // no time for more
      incumbent_.raise(weights_.total() - detail::reachable_weight(instance_, weights_), BoundProof::trivial,
                       step);
    MaxCoverage answer;
    fill(answer);
    answer.at_most = at_most_;
    const double bound = weights_.total() - incumbent_.bound();
    if (!has_weights(instance_.table)) {
      answer.upper_bound = static_cast<std::size_t>(bound);
      return answer;
    }
    const std::vector<bool> can = detail::reachable_labels(instance_);
    answer.upper_bound = static_cast<std::size_t>(std::count(can.begin(), can.end(), true));
    const double reached = weights_.without(answer.missed);
    answer.weight = CoverageWeight{weights_.in_table(reached), weights_.in_table(weights_.total()),
                                   weights_.in_table(std::max(bound, reached))};
    return answer;
  }

 private:
  double missed_by(const Check& check) const { return weights_.total() - weights_.without(check.unmet); }
  double reached() const { return weights_.total() - incumbent_.value(); }
  double shown(double missed) const override { return weights_.in_table(weights_.total() - missed); }
  bool is_settled() const override { return is_settled_; }
  std::uint64_t long_walk() const override { return 4'000'000; }

  // Of equal weights, fewer units.
  void offer(const Selection& selected) override {
    const Check check = instance_.check(selected);
    const double missed = missed_by(check), known = incumbent_.value();
    if (check.allowed() && selected.size() <= at_most_ &&
        (missed < known || (missed == known && selected.size() < incumbent_.selected().size())))
      incumbent_.replace(selected, missed);
  }

  void begin(const Effort& effort) override { offer_compact(detail::first_units(order_, units_), effort); }

  bool anneal(const detail::CoverageAnnealing& annealing, const Effort& effort, std::uint32_t seed) override {
    const Selection start = filled();
    if (!instance_.can_exchange(start)) return false;
    if (const auto found = annealing.for_more(reached(), start, effort, seed, control_)) {
      offer_compact(*found, effort);
      solver_ = {Method::search};
    }
    return true;
  }

  void raise_by_multipliers(const Effort& effort) override {
    CoverageBound bound(instance_, weights_, units_);
    incumbent_.raise(weights_.total() - bound.weight(units_), BoundProof::trivial, step);
    bound.improve(units_, reached(), CoverageAim::lowest,
                  detail::bound_effort(bound.entries(), effort, instance_.table), control_);
    incumbent_.raise(weights_.total() - bound.weight(units_), BoundProof::dual, step);
  }

  void raise_by_enumeration(const Effort& effort) override { is_settled_ = enumerate(effort); }

  // Whole weights: a unit of missed weight costs more than all units together, so the missed weight is
  // minimised first and units second. Units cost nothing if they are not.
  MipQuestion mip_question() const override {
    const bool are_whole = weights_.are_whole();
    const double unit_price = are_whole ? 1 : 0;
    const double price = are_whole ? static_cast<double>(instance_.columns() + 1) : 1;
    const double known =
        unit_price * static_cast<double>(incumbent_.selected().size()) + price * incumbent_.value();
    return {{.cost = unit_cost_, .max_count = units_, .price_of_misses = price},
            known - unit_price / 2,
            [=, this](const detail::CoverModel::Outcome& outcome) {
              // A bound d on count + price missed, with count <= units < price, proves missed >= (d - units)
              // / price.
              const double least = (outcome.bound - unit_price * static_cast<double>(units_)) / price;
              const double missed = are_whole ? std::ceil(least - 1e-6) : least * (1 - 1e-9);
              return std::clamp(missed, 0.0, weights_.total());
            }};
  }

  /// The incumbent, with further units of the greedy selection up to the allowed number.
  Selection filled() const {
    Selection result;
    std::vector<bool> is_out(instance_.columns(), false);
    const auto take = [&](ColumnId j) {
      if (is_out[j] || result.size() >= units_) return;
      result.push_back(j);
      is_out[j] = true;
      for (const ColumnId other : instance_.excludes[j]) is_out[other] = true;
    };
    std::for_each(incumbent_.selected().begin(), incumbent_.selected().end(), take);
    std::for_each(order_.begin(), order_.end(), take);
    std::sort(result.begin(), result.end());
    return result;
  }

  /// Proves the value, then looks for fewer units of the same value; false if the work was not enough.
  bool enumerate(const Effort& effort) {
    detail::CoverageTable table(instance_, weights_);
    Effort left = detail::enumeration_effort(effort, instance_.table);
    const auto examine = [&](std::size_t units, double weight, EnumerationAim aim) {
      auto found = enumerate_coverage(table, weights_, units, weight, aim, left, control_);
      if (found.selected) offer(*found.selected);
      return found;
    };
    const bool was_open = !incumbent_.is_closed();
    if (was_open) {
      const auto best = examine(units_, reached() + weights_.step(), EnumerationAim::best);
      if (!best.is_complete) return false;
      const auto strength = judged(instance_, weights_, best.proof, units_, reached() + weights_.step(),
                                   {.until = effort.until}, control_);
      if (!strength) return false;
      // Weights that are not whole may be larger by less than a step, as CoverageWeight says.
      incumbent_.raise(incumbent_.value(), *strength, step);
      solver_ = {Method::search};
      offer_compact(incumbent_.selected(), effort);
    }
    while (incumbent_.selected().size() > table.installed().size()) {
      const std::size_t size = incumbent_.selected().size();
      const auto fewer = examine(size - 1, reached(), EnumerationAim::first);
      if (!fewer.is_complete) return was_open;
      if (incumbent_.selected().size() == size) break;
    }
    solver_ = {Method::search};
    return true;
  }

  std::size_t at_most_, units_;
  std::vector<double> unit_cost_;
  bool is_settled_ = false;  ///< no selection reaches more, or as much with fewer units
};

}  // namespace

MaxCoverage maximise_coverage(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                              const PlaceOptions& options, const RunControl& control) {
  return detail::search_partial(table, problem, options, control, [&](const detail::Instance& instance) {
    if (const std::size_t installed = instance.installed.size(); installed > units)
      throw InputError("number of units",
                       fmt::format("is {}, but {} units are installed or pinned", units, installed),
                       "use at least this number", Setting::units);
    return Maximisation(instance, units, options, control).run();
  });
}

}  // namespace shelfbeam
