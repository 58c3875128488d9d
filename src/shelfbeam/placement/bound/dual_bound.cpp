#include "shelfbeam/placement/bound/dual_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A mounting point without a chosen unit, or a column with a mounting point of its own.
struct Point {
  std::vector<ColumnId> options = {};
  double min_cost = infinite;  ///< of its options, reduced
};

/// The points with open columns.
std::vector<Point> free_points(const Instance& instance, const std::vector<ColumnState>& states,
                               const std::vector<double>& reduced_cost) {
  std::vector<Point> points(instance.columns());
  for (std::uint32_t j = 0; j < instance.columns(); ++j) {
    if (states[j] != ColumnState::open) continue;
    Point& point = points[instance.mounts.first_option(j)];
    point.options.push_back(j);
    point.min_cost = std::min(point.min_cost, reduced_cost[j]);
  }
  std::erase_if(points, [](const Point& point) { return point.options.empty(); });
  return points;
}

/// The minimum over T before points are taken.
struct Relaxation {
  DualBound dual;             ///< with the chosen units
  std::vector<Point> points;  ///< free ones, the cheapest first
  std::size_t chosen = 0;     ///< number of units
  double slack = 0;           ///< infinite if the sums are
};

Relaxation relaxation_of(const Instance& instance, const DualSums& sums, std::span<const double> cost,
                         const SelectionSet& selections) {
  const std::size_t n = instance.columns();
  Relaxation result;
  DualBound& dual = result.dual;
  dual.bound = sums.constant;
  double added = dual.bound;
  for (std::size_t j = 0; j < n; ++j) {
    dual.reduced_cost.push_back(cost[j] - sums.weight[j]);
    added += std::abs(cost[j]) + sums.weight[j];
  }
  result.slack = std::isfinite(added)
                     ? static_cast<double>(sums.rows + n + 8) * std::numeric_limits<double>::epsilon() * added
                     : infinite;
  const std::vector<ColumnState> states = states_of(instance, selections);
  for (std::size_t j = 0; j < n; ++j) {
    dual.if_chosen.push_back(states[j] == ColumnState::closed ? infinite : 0);
    if (states[j] != ColumnState::chosen) continue;
    dual.bound += dual.reduced_cost[j];
    ++result.chosen;
  }
  result.points = free_points(instance, states, dual.reduced_cost);
  std::ranges::stable_sort(result.points, {}, &Point::min_cost);
  return result;
}

/// Adds the taken points to the bound and sets `if_chosen` to the increase that each column causes.
void take_points(std::span<const Point> points, std::size_t min_count, std::size_t max_count,
                 DualBound& dual) {
  const auto negative = static_cast<std::size_t>(
      std::ranges::count_if(points, [](const Point& point) { return point.min_cost < 0; }));
  max_count = std::min(max_count, points.size());
  min_count = std::min(min_count, max_count);
  const std::size_t taken = std::clamp(negative, min_count, max_count);
  // If the count is at its maximum, or at a minimum that forces units, a further unit replaces the last.
  const bool replaces = taken == max_count || (taken == min_count && negative < min_count);
  const double last = taken > 0 ? points[taken - 1].min_cost : 0;
  const double of_further = max_count == 0 ? -infinite : replaces ? last : 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& point = points[k];
    if (k < taken) dual.bound += point.min_cost;
    const double replaced = k < taken ? point.min_cost : of_further;
    for (const ColumnId j : point.options) dual.if_chosen[j] = dual.reduced_cost[j] - replaced;
  }
}

}  // namespace

std::vector<ColumnState> states_of(const Instance& instance, const SelectionSet& selections) {
  std::vector<ColumnState> states(instance.columns(), ColumnState::open);
  for (std::uint32_t j = 0; j < states.size(); ++j)
    if (!instance.mounts.available(j)) states[j] = ColumnState::closed;
  for (const ColumnId j : selections.without) states[j] = ColumnState::closed;
  for (const ColumnId j : instance.installed) states[j] = ColumnState::chosen;
  for (const ColumnId j : selections.with) {
    for (const ColumnId option : instance.mounts.options(j)) states[option] = ColumnState::closed;
    states[j] = ColumnState::chosen;
  }
  return states;
}

DualSums dual_sums(const Instance& instance, std::span<const BoundRow> rows, std::span<const double> y,
                   std::size_t max_count, std::span<const double> price_of_miss) {
  // Parts of fixed sizes, so that the sums do not depend on the number of threads.
  constexpr std::size_t min_rows = 2048, max_parts = 16;
  const std::size_t rows_of_part = std::max(min_rows, rows.size() / max_parts + 1);
  const std::size_t parts = (rows.size() + rows_of_part - 1) / rows_of_part;
  std::vector<DualSums> of_part(parts);
  std::vector<double> of_row(rows.size(), 0.0);
  for_each_task(parts, [&](std::size_t p) {
    std::vector<double>& weight = of_part[p].weight;
    weight.assign(instance.columns(), 0.0);
    const CoverRows cover(instance, max_count);
    for (std::size_t k = p * rows_of_part; k < std::min(rows.size(), (p + 1) * rows_of_part); ++k)
      if (y[k] > 0 && std::isfinite(y[k]))
        of_row[k] = y[k] * cover.read(rows[k], [&](std::uint32_t j, double a) { weight[j] += y[k] * a; });
  });
  DualSums sums{0, std::vector<double>(instance.columns(), 0.0), rows.size(), max_count};
  for (const DualSums& part : of_part)
    for (std::size_t j = 0; j < part.weight.size(); ++j) sums.weight[j] += part.weight[j];
  std::vector<double> of_label(price_of_miss.size(), 0.0);
  for (std::size_t k = 0; k < rows.size(); ++k)
    (price_of_miss.empty() ? sums.constant : of_label[rows[k].label]) += of_row[k];
  for (std::size_t i = 0; i < of_label.size(); ++i) sums.constant += std::min(of_label[i], price_of_miss[i]);
  return sums;
}

DualBound dual_bound(const Instance& instance, std::span<const BoundRow> rows, std::span<const double> y,
                     std::span<const double> cost, const SelectionSet& selections) {
  const DualSums sums = dual_sums(instance, rows, y, selections.max_count);
  Relaxation relaxation = relaxation_of(instance, sums, cost, selections);
  DualBound& dual = relaxation.dual;
  if (std::isinf(relaxation.slack)) {
    dual.bound = -infinite;
    dual.if_chosen.assign(instance.columns(), -infinite);
    return std::move(dual);
  }
  const std::size_t count = relaxation.chosen;
  take_points(relaxation.points, selections.min_count - std::min(selections.min_count, count),
              selections.max_count - std::min(selections.max_count, count), dual);
  dual.bound -= relaxation.slack;
  for (double& cost_with : dual.if_chosen) cost_with += dual.bound;
  return std::move(dual);
}

BoundsByCount bounds_by_count(const Instance& instance, const DualSums& sums, std::span<const double> cost) {
  const Relaxation relaxation = relaxation_of(instance, sums, cost, {});
  BoundsByCount bounds{std::vector<double>(sums.max_count + 1, infinite), relaxation.slack};
  const bool is_finite = !std::isinf(relaxation.slack);
  double bound = is_finite ? relaxation.dual.bound - relaxation.slack : -infinite;
  for (std::size_t k = relaxation.chosen; k <= sums.max_count; ++k) {
    const std::size_t taken = k - relaxation.chosen;
    if (is_finite && taken > 0 && taken <= relaxation.points.size())
      bound += std::min(0.0, relaxation.points[taken - 1].min_cost);
    bounds.at_most[k] = bound;
  }
  return bounds;
}

std::vector<ColumnId> useless_columns(const DualBound& dual, double worth) {
  return numbers_where<ColumnId>(dual.if_chosen.size(),
                                 [&](ColumnId j) { return dual.if_chosen[j] > worth; });
}

}  // namespace shelfbeam::detail
