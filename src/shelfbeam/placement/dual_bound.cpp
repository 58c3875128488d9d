#include "shelfbeam/placement/detail/dual_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/placement/detail/bound_row.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// sum_i y_i b_i and, per column, sum_i y_i a_ij.
struct Combination {
  double bound = 0;
  std::vector<double> weight;

  Combination(const SignalTable& table, const Question& question, std::span<const BoundRow> rows,
              std::span<const double> y, std::size_t most_units)
      : weight(table.columns(), 0.0) {
    BoundRowReader reader(table, question.model, most_units);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (y[k] > 0 && std::isfinite(y[k]))
        bound += y[k] * reader.read(rows[k], [&](std::uint32_t j, double a) { weight[j] += y[k] * a; });
  }
};

/// The least of sum r_j T_j over the options of a mounting point, and how much more it is with one T_j given.
void add_mount(std::span<const std::uint32_t> options, const SignalTable& table, DualBound& dual) {
  const auto installed = std::find_if(options.begin(), options.end(),
                                      [&](std::uint32_t j) { return table.transceivers[j].installed; });
  if (installed != options.end()) {
    dual.bound += dual.reduced_cost[*installed];
    for (const std::uint32_t j : options) (j == *installed ? dual.if_left_out : dual.if_chosen)[j] = infinite;
    return;
  }
  double least = 0, second = 0;  // nothing chosen costs 0
  for (const std::uint32_t j : options) {
    const double r = dual.reduced_cost[j];
    second = std::min(second, std::max(least, r));
    least = std::min(least, r);
  }
  for (const std::uint32_t j : options) {
    const double r = dual.reduced_cost[j];
    dual.if_chosen[j] = r - least;
    dual.if_left_out[j] = (r == least ? second : least) - least;
  }
  dual.bound += least;
}

}  // namespace

DualBound dual_bound(const SignalTable& table, const Question& question, std::span<const BoundRow> rows,
                     std::span<const double> y, std::span<const double> cost, std::size_t most_units) {
  const std::size_t n = table.columns();
  const Combination combination(table, question, rows, y, most_units);
  DualBound dual{combination.bound, std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), {}};
  double added = combination.bound;
  for (std::size_t j = 0; j < n; ++j) {
    dual.reduced_cost.push_back(cost[j] - combination.weight[j]);
    added += std::abs(cost[j]) + combination.weight[j];
  }

  std::vector<bool> shares(n, false);
  for (const auto& mount : table.mounts) {
    for (const std::uint32_t j : mount) shares[j] = true;
    add_mount(mount, table, dual);
  }
  for (std::uint32_t j = 0; j < n; ++j) {
    if (shares[j]) continue;
    const std::uint32_t options[] = {j};
    add_mount(options, table, dual);
  }

  const double slack =
      static_cast<double>(rows.size() + n + 8) * std::numeric_limits<double>::epsilon() * added;
  dual.bound = std::isfinite(added) ? dual.bound - slack : -infinite;
  for (std::size_t j = 0; j < n; ++j) {
    dual.if_chosen[j] += dual.bound;
    dual.if_left_out[j] += dual.bound;
  }
  return dual;
}

FixedColumns fix_columns(const DualBound& dual, double worth) {
  FixedColumns fixed;
  for (std::uint32_t j = 0; j < dual.if_chosen.size(); ++j) {
    if (dual.if_left_out[j] > worth) fixed.chosen.push_back(j);
    if (dual.if_chosen[j] > worth) fixed.left_out.push_back(j);
  }
  return fixed;
}

}  // namespace shelfbeam::detail
