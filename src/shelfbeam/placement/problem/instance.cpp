#include "shelfbeam/placement/problem/instance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

namespace {

bool have_one_price(const SignalTable& table) {
  constexpr double nearly_all = 0.9;
  std::map<double, std::size_t> count;
  std::size_t all = 0, largest = 0;
  for (const SignalTable::Transceiver& unit : table.transceivers) {
    if (unit.installed) continue;
    largest = std::max(largest, ++count[unit.cost]);
    ++all;
  }
  return all > 0 && static_cast<double>(largest) >= nearly_all * static_cast<double>(all);
}

}  // namespace

Instance::Instance(const SignalTable& t, const PlacementProblem& q)
    : table(t),
      problem(q),
      mounts(t),
      installed(numbers_where<ColumnId>(t.columns(), [&](ColumnId j) { return is_installed(j); })),
      available(t.columns(), true),
      excludes(t.columns()),
      second_cost(objective_coefficients(t, q)),
      first_cost(first_objective(t, q, second_cost)),
      bounds(t, first_cost),
      second_bounds(t, second_cost) {
  const std::vector<double>& coefficients = is_weighted() ? first_cost : second_cost;
  const double largest =
      coefficients.empty() ? 0 : *std::max_element(coefficients.begin(), coefficients.end());
  constexpr double bits = 60;  // of the cost of all columns together
  if (largest > 0)
    cost_unit = std::exp2(std::ceil(std::log2(largest) + std::log2(static_cast<double>(t.columns()))) - bits);
  for (const double coefficient : coefficients) cost.push_back(std::llround(coefficient / cost_unit));
  has_costs = std::any_of(cost.begin(), cost.end(), [](std::int64_t c) { return c != 0; });
  for (std::uint32_t j = 0; j < t.columns(); ++j) {
    mounts.for_each_conflict(j, [&](std::uint32_t other) { excludes[j].push_back(other); });
    available[j] = mounts.available(j) && !is_installed(j);
  }
  has_covers_of_sums = is_cover_of_sums(t, q);
  has_one_price = have_one_price(t);
}

double Instance::value_of(std::span<const ColumnId> selected) const {
  const Check checked = check(selected);
  if (!checked.met()) return std::numeric_limits<double>::infinity();
  return is_weighted() ? checked.objective + checked.transceiver_cost : static_cast<double>(selected.size());
}

double Instance::second_value_of(std::span<const ColumnId> selected) const {
  const Check checked = check(selected);
  return checked.objective + (is_weighted() ? checked.transceiver_cost : 0);
}

std::size_t Instance::trivial_count_bound() const {
  const std::size_t min_count = installed.size() + (check(installed).unmet.empty() ? 0 : 1);
  return problem.redundant && rows() > 0 ? std::max<std::size_t>(min_count, 2) : min_count;
}

bool Instance::can_exchange(std::span<const ColumnId> selected) const {
  const auto candidates = std::ranges::count(available, true);
  const auto chosen = std::ranges::count_if(selected, [&](ColumnId j) { return available[j]; });
  return 0 < chosen && chosen < candidates;
}

bool Instance::is_first_by_id(std::span<const ColumnId> a, std::span<const ColumnId> b) const {
  const auto ids = [&](std::span<const ColumnId> selected) {
    std::vector<std::string_view> result;
    for (const ColumnId j : selected) result.emplace_back(table.transceivers[j].id);
    std::sort(result.begin(), result.end());
    return result;
  };
  return ids(a) < ids(b);
}

}  // namespace shelfbeam::detail
