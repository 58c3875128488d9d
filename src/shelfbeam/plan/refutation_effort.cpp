#include "shelfbeam/plan/refutation_effort.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/plan/verification.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

RelaxedCover relaxed_cover(const SignalTable& table, const SelectionBudget& limit, const Deadline& deadline,
                           const RunControl& control) {
  constexpr std::size_t rows_at_once = 64;
  constexpr double below = 1 - 1e-4, tolerance = 1e-6;
  const auto n = static_cast<std::uint32_t>(table.columns());
  std::vector<milp::Column> columns;
  for (std::uint32_t j = 0; j < n; ++j)
    columns.push_back({0, table.transceivers[j].installed ? 1.0 : 0.0, 1, false, {}});
  columns.push_back({-1, 0, milp::infinity, false, {}});
  auto lp = milp::backends().front().lp(columns);
  std::vector<milp::Row> fixed(1);
  fixed[0].upper = limit.budget;
  for (std::uint32_t j = 0; j < n; ++j) fixed[0].entries.push_back({j, limit.price[j]});
  for (const auto& mount : table.mounts) fixed.push_back(milp::sum_row(mount, -milp::infinity, 1));
  lp->add_rows(fixed);
  const auto share = [&](LabelId i, const SignalEntry& entry) {
    return std::min(1.0, entry.signal / table.labels[i].requirement);
  };
  std::vector<double> units(n, 1.0);
  std::vector<LabelId> loaded;
  std::vector<bool> is_loaded(table.rows(), false);
  RelaxedCover result;
  double coverage = std::numeric_limits<double>::infinity();
  while (!control.cancelled() && !deadline.has_passed()) {
    std::vector<std::pair<double, LabelId>> short_of;
    for (std::uint32_t i = 0; i < table.rows(); ++i) {
      if (is_loaded[i]) continue;
      double sum = 0;
      for (const SignalEntry& entry : table.row(i)) sum += share(i, entry) * units[entry.transceiver];
      if (sum < coverage - tolerance) short_of.emplace_back(sum, i);
    }
    if (short_of.empty()) return result;
    std::sort(short_of.begin(), short_of.end());
    short_of.resize(std::min(short_of.size(), rows_at_once));
    std::vector<milp::Row> rows;
    for (const auto& [sum, i] : short_of) {
      milp::Row row{0, milp::infinity, {{n, -1.0}}, {}};
      for (const SignalEntry& entry : table.row(i))
        row.entries.push_back({entry.transceiver, share(i, entry)});
      rows.push_back(std::move(row));
      is_loaded[i] = true;
      loaded.push_back(i);
    }
    lp->add_rows(rows);
    const milp::LpResult solved = lp->solve(deadline.seconds_left(), control);
    if (solved.termination != milp::Termination::optimal) return result;
    coverage = solved.x[n];
    units.assign(solved.x.begin(), solved.x.begin() + n);
    if (coverage < below) {
      constexpr double negligible = 1e-4;
      for (std::size_t k = 0; k < loaded.size(); ++k)
        if (solved.y[fixed.size() + k] > negligible) result.labels.push_back(loaded[k]);
      std::sort(result.labels.begin(), result.labels.end());
      result.is_refuted = true;
      return result;
    }
  }
  return result;
}

double needed_samples(const Refutation& refutation, const SignalTable& table, const SignalMatrix& matrix,
                      double level) {
  const std::size_t n = table.columns();
  // Limits of skewed sums are wider than Student's.
  constexpr double skewed = 1.25;
  const double quantile = -skewed * student_quantile(level, min_verifying_batches - 1);
  // By weights and column: the mean, and the variance of one sample.
  std::vector<std::vector<double>> mean, variance;
  for (const Refutation::Weights& weights : refutation.weights) {
    std::vector<double> x(n, 0.0), v(n, 0.0);
    for (std::size_t k = 0; k < weights.rows.size(); ++k) {
      const std::uint32_t row = weights.rows[k], i = refutation.labels[row];
      const double share = weights.weight[k] / table.labels[i].requirement;
      for (std::size_t j = 0; j < n; ++j)
        if (refutation.is_clipped[row][j]) x[j] += weights.weight[k];
      for (const SignalEntry& entry : table.row(i)) {
        const std::uint32_t j = entry.transceiver;
        if (refutation.is_clipped[row][j]) continue;
        x[j] += share * entry.signal;
        const double error = share * static_cast<double>(matrix.standard_error[matrix.at(i, j)]);
        v[j] += error * error * static_cast<double>(matrix.labels[i].samples);
      }
    }
    mean.push_back(std::move(x));
    variance.push_back(std::move(v));
  }
  LeafTotal total(refutation.limit, refutation.mounts);
  std::vector<double> limit(n);
  double needed = 1;
  for (const Refutation::Leaf& leaf : refutation.leaves) {
    const auto is_refuted = [&](double samples) {
      for (const auto* columns : {&leaf.chosen, &leaf.free})
        for (const std::uint32_t j : *columns)
          limit[j] = mean[leaf.weights][j] + quantile * std::sqrt(variance[leaf.weights][j] / samples);
      return total(leaf.chosen, leaf.free, limit) < 1;
    };
    if (is_refuted(needed)) continue;
    double high = 2 * needed;
    constexpr double hopeless = 1e12;
    while (high < hopeless && !is_refuted(high)) high *= 2;
    if (high >= hopeless) return std::numeric_limits<double>::infinity();
    for (int step = 0; step < 6; ++step) {
      const double middle = std::sqrt(needed * high);
      (is_refuted(middle) ? high : needed) = middle;
    }
    needed = high;
  }
  return needed;
}

}  // namespace shelfbeam
