#include "shelfbeam/placement/problem/spend.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>

#include "shelfbeam/placement/problem/bounds.hpp"

namespace shelfbeam {

namespace {

// Prices that are whole numbers of hundredths share a step; larger ones would not be exact.
constexpr double hundredths = 100, max_price = 1e12;
constexpr double relative_rounding = 1e-9;
// The relative error of a price in hundredths: the nearest double, multiplied.
constexpr double representation = 1e-15;
// A share of the known spend, for prices without a common step.
constexpr double share_of_tie = 1e-6;

}  // namespace

Price price_of(const SignalTable& table, std::span<const ColumnId> selected) {
  Price price{table.currency};
  for (const ColumnId j : selected) {
    price.total += table.transceivers[j].cost;
    price.to_spend += price_to_spend(table.transceivers[j]);
  }
  return price;
}

std::vector<double> prices_to_spend(const SignalTable& table) {
  std::vector<double> prices;
  std::ranges::transform(table.transceivers, std::back_inserter(prices), price_to_spend);
  return prices;
}

bool has_prices(const SignalTable& table) {
  return !table.currency.empty() ||
         std::any_of(table.transceivers.begin(), table.transceivers.end(),
                     [](const SignalTable::Transceiver& unit) { return unit.cost != 1; });
}

PlacementProblem resolved(const PlacementProblem& problem, const SignalTable& table) {
  PlacementProblem result = problem;
  if (problem.combination != Combination::automatic) return result;
  result.combination = Combination::lexicographic;
  if (problem.objective != Objective::count) return result;
  const SignalTable::Transceiver* first = nullptr;
  for (const SignalTable::Transceiver& unit : table.transceivers) {
    if (unit.installed) continue;
    if (first == nullptr) first = &unit;
    if (unit.cost != first->cost) result.combination = Combination::spend;
  }
  return result;
}

double price_step(std::span<const double> prices) {
  std::int64_t step = 0;
  for (const double price : prices) {
    const double scaled = price * hundredths;
    if (!(scaled < max_price) || std::abs(scaled - std::round(scaled)) > representation * scaled) return 0;
    step = std::gcd(step, static_cast<std::int64_t>(std::round(scaled)));
  }
  return static_cast<double>(step) / hundredths;
}

SpendOrder::SpendOrder(const SignalTable& table, double known) : price_(prices_to_spend(table)) {
  const CostBounds bounds(table, price_);
  max_units_ = static_cast<double>((std::isfinite(known) ? bounds.affordable(known) : table.columns()) -
                                   bounds.installed());
  const double all = std::accumulate(price_.begin(), price_.end(), 0.0);
  if (!(all > 0)) return;
  step_ = price_step(price_);
  is_whole_ = step_ > 0;
  if (!is_whole_) step_ = share_of_tie * (known > 0 && std::isfinite(known) ? known : all);
}

SignalTable SpendOrder::priced(SignalTable table) const {
  for (std::size_t j = 0; j < price_.size(); ++j) {
    const double steps = price_[j] / step_;
    table.transceivers[j].cost = (max_units_ + 1) * (is_whole_ ? std::round(steps) : steps) +
                                 (table.transceivers[j].installed ? 0 : 1);
  }
  return table;
}

double SpendOrder::spend_bound(double bound) const {
  if (!std::isfinite(bound)) return bound;
  const double steps = std::max(0.0, (bound - max_units_) / (max_units_ + 1));
  return step_ * (is_whole_ ? std::ceil(steps * (1 - relative_rounding) - relative_rounding) : steps);
}

}  // namespace shelfbeam
