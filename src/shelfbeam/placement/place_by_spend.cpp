#include "shelfbeam/placement/place_by_spend.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double unknown_spend = std::numeric_limits<double>::infinity();

/// Takes the selection of fewest units if it is cheaper, and the cheapest units of its bound as a bound on
/// the spend; or its proof that no selection is feasible.
void learn_from_count(Placement& placement, const SignalTable& table, const Placement& of_count) {
  if (of_count.status == Status::infeasible) {
    placement.status = Status::infeasible;
    placement.lower_bound = placement.count_lower_bound = unknown_spend;
    placement.bound_proof = of_count.bound_proof;
    placement.solver = of_count.solver;
    return;
  }
  if (of_count.has_selection()) {
    const Price price = price_of(table, of_count.selected);
    const auto rank = [](const Price& of, std::size_t units) { return std::pair(of.to_spend, units); };
    if (!placement.has_selection() ||
        rank(price, of_count.count()) < rank(*placement.price, placement.count())) {
      placement.selected = of_count.selected;
      placement.price = price;
      placement.objective_value = price.to_spend;
      placement.solver = of_count.solver;
    }
  }
  placement.lower_bound = std::min(placement.lower_bound, placement.objective_value);
  // The file states one proof for both bounds, the weaker one.
  const auto rests_on_count = [&] {
    placement.bound_proof = std::max(placement.bound_proof, of_count.bound_proof);
  };
  if (of_count.count_lower_bound > placement.count_lower_bound) {
    placement.count_lower_bound = of_count.count_lower_bound;
    rests_on_count();
  }
  const double floor = CostBounds(table, prices_to_spend(table))
                           .cheapest(static_cast<std::size_t>(of_count.count_lower_bound));
  if (floor > placement.lower_bound) {
    placement.lower_bound = std::min(floor, placement.objective_value);
    rests_on_count();
  }
  const auto count = static_cast<double>(placement.count());
  if (placement.has_selection() && placement.gap() <= 0 && count <= placement.count_lower_bound)
    placement.status = Status::optimal;
}

/// Reports prices in place of sums.
class SpendProgress final : public ProgressSink {
 public:
  SpendProgress(const SignalTable& table, const SpendOrder& order, ProgressSink& watcher)
      : table_(table), order_(order), watcher_(watcher) {}

  void bounds(double /*incumbent*/, double lower_bound) override { lower_ = order_.spend_bound(lower_bound); }
  void selection(const std::vector<std::string>& ids) override {
    const std::set<std::string_view> chosen(ids.begin(), ids.end());
    spend_ = 0;
    for (const SignalTable::Transceiver& unit : table_.transceivers)
      if (chosen.contains(unit.id)) spend_ += price_to_spend(unit);
    ids_ = ids;
  }
  void report(Task task, double fraction, std::string_view detail) override {
    watcher_.bounds(spend_, std::min(lower_, spend_));
    watcher_.selection(ids_);
    const std::size_t step = std::min(detail.size(), detail.find(';'));
    watcher_.report(
        task, fraction,
        fmt::format("best {:.6g}, bound {:.6g}{}", spend_, std::min(lower_, spend_), detail.substr(step)));
  }

 private:
  const SignalTable& table_;
  const SpendOrder& order_;
  ProgressSink& watcher_;
  std::vector<std::string> ids_;
  double spend_ = unknown_spend, lower_ = 0;
};

}  // namespace

Placement place_by_spend(const SignalTable& table, const PlacementProblem& problem,
                         const PlaceOptions& options, const RunControl& control) {
  constexpr double share_of_greedy = 0.4, share_of_sum = 0.4;
  const Deadline deadline(options.time_limit_s);
  PlacementProblem sum = problem;
  sum.combination = Combination::weighted;
  const Effort effort = greedy_effort(options, share_of_greedy * options.time_limit_s);
  const Stopwatch watch;
  const Instance instance(table, problem);
  double known = unknown_spend;
  const SignalTable priced = SpendOrder(table, known).priced(table);
  Selection start;
  for (const auto& selected : {greedy_selection({priced, sum}, effort, control), options.start})
    if (!selected.empty() && instance.check(selected).met()) {
      const double price = price_of(table, selected).to_spend;
      if (price >= known) continue;
      known = price;
      start = selected;
    }
  const SpendOrder order(table, known);
  const bool counts = options.proves && options.uses(SolverChoice::search) && instance.has_one_price;
  PlaceOptions of_sum = options;
  of_sum.start = start;
  of_sum.time_limit_s = (counts ? share_of_sum : 1) * deadline.seconds_left();
  std::optional<SpendProgress> progress;
  if (control.progress != nullptr) progress.emplace(table, order, *control.progress);
  Placement placement = place(order.priced(table), sum, of_sum,
                              {control.threads, control.cancel, progress ? &*progress : nullptr});
  placement.problem = problem;
  placement.price.reset();
  placement.seconds = watch.seconds();
  if (placement.status == Status::infeasible) return placement;
  if (placement.has_selection()) {
    placement.price = price_of(table, placement.selected);
    placement.objective_value = placement.price->to_spend;
  }
  placement.lower_bound = placement.status == Status::optimal
                              ? placement.objective_value
                              : std::min(order.spend_bound(placement.lower_bound), placement.objective_value);
  const bool is_over = !options.step_limit && deadline.has_passed();
  if (placement.status == Status::optimal || !counts || is_over || control.cancelled()) return placement;
  PlacementProblem count = problem;
  count.combination = Combination::lexicographic;
  PlaceOptions of_count = options;
  of_count.time_limit_s = deadline.seconds_left();
  of_count.settles_ties = false;
  of_count.start = placement.selected;
  const Placement counted = place(table, count, of_count, control);
  learn_from_count(placement, table, counted);
  placement.steps.insert(placement.steps.end(), counted.steps.begin(), counted.steps.end());
  placement.seconds = watch.seconds();
  return placement;
}

Effort greedy_effort(const PlaceOptions& options, double seconds) {
  if (options.step_limit) return {};
  return for_seconds(seconds);
}

}  // namespace shelfbeam::detail
