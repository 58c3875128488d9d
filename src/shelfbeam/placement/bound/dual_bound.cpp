#include "shelfbeam/placement/bound/dual_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shelfbeam/base/parallel.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// A mounting point without a chosen unit, or a column with a mounting point of its own.
struct Point {
  std::vector<ColumnId> options;
  double min_cost = infinite;  ///< of its options, reduced
};

Point make_point(std::vector<ColumnId> options, const std::vector<double>& reduced_cost) {
  double min_cost = infinite;
  for (const ColumnId j : options) min_cost = std::min(min_cost, reduced_cost[j]);
  return {std::move(options), min_cost};
}

/// The mounting points without a chosen unit. Adds the chosen units to the bound and excludes the other
/// options of their points, and columns in conflict with installed units.
std::vector<Point> free_points(const Instance& instance, const std::vector<bool>& chosen,
                               const std::vector<ColumnId>& without, DualBound& dual) {
  std::vector<Point> points;
  std::vector<bool> shares(instance.columns(), false), is_out(instance.columns(), false);
  for (const ColumnId j : without) is_out[j] = true;
  for (std::uint32_t j = 0; j < instance.columns(); ++j) {
    is_out[j] = is_out[j] || (!instance.available[j] && !chosen[j]);
    if (is_out[j]) dual.if_chosen[j] = infinite;
  }
  for (const auto& mount : instance.table.mounts) {
    bool taken = false;
    for (const ColumnId j : mount) {
      shares[j] = true;
      taken = taken || chosen[j];
    }
    for (const ColumnId j : mount)
      if (taken && !chosen[j]) dual.if_chosen[j] = infinite;
    std::vector<ColumnId> options;
    for (const ColumnId j : mount)
      if (!is_out[j]) options.push_back(j);
    if (!taken && !options.empty()) points.push_back(make_point(std::move(options), dual.reduced_cost));
  }
  for (std::uint32_t j = 0; j < instance.columns(); ++j) {
    if (chosen[j])
      dual.bound += dual.reduced_cost[j];
    else if (!shares[j] && !is_out[j])
      points.push_back(make_point({j}, dual.reduced_cost));
  }
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
  dual.if_chosen.assign(n, 0.0);
  double added = dual.bound;
  for (std::size_t j = 0; j < n; ++j) {
    dual.reduced_cost.push_back(cost[j] - sums.weight[j]);
    added += std::abs(cost[j]) + sums.weight[j];
  }
  result.slack = std::isfinite(added)
                     ? static_cast<double>(sums.rows + n + 8) * std::numeric_limits<double>::epsilon() * added
                     : infinite;
  std::vector<bool> chosen = chosen_columns(instance, instance.installed);
  for (const ColumnId j : selections.with) chosen[j] = true;
  result.chosen = static_cast<std::size_t>(std::count(chosen.begin(), chosen.end(), true));
  result.points = free_points(instance, chosen, selections.without, dual);
  std::stable_sort(result.points.begin(), result.points.end(),
                   [](const Point& a, const Point& b) { return a.min_cost < b.min_cost; });
  return result;
}

/// Adds the taken points to the bound and sets `if_chosen` to the increase that each column causes.
void take_points(std::span<const Point> points, std::size_t min_count, std::size_t max_count,
                 DualBound& dual) {
  const auto negative = static_cast<std::size_t>(
      std::count_if(points.begin(), points.end(), [](const Point& point) { return point.min_cost < 0; }));
  max_count = std::min(max_count, points.size());
  min_count = std::min(min_count, max_count);
  const std::size_t taken = std::clamp(negative, min_count, max_count);
  const double last = taken > 0 ? points[taken - 1].min_cost : 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Point& point = points[k];
    const bool is_taken = k < taken;
    if (is_taken) dual.bound += point.min_cost;
    // If the count is at its maximum, or at a minimum that forces units, a further unit replaces the last.
    const bool replaces = taken == max_count || (taken == min_count && negative < min_count);
    for (const ColumnId j : point.options) {
      const double r = dual.reduced_cost[j];
      if (is_taken)
        dual.if_chosen[j] = r - point.min_cost;
      else
        dual.if_chosen[j] = max_count == 0 ? infinite : r - (replaces ? last : 0);
    }
  }
}

}  // namespace

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
  std::vector<ColumnId> useless;
  for (std::uint32_t j = 0; j < dual.if_chosen.size(); ++j)
    if (dual.if_chosen[j] > worth) useless.push_back(j);
  return useless;
}

}  // namespace shelfbeam::detail
