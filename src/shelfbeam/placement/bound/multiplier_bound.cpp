#include "shelfbeam/placement/bound/multiplier_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/steps.hpp"
#include "shelfbeam/placement/bound/ascent.hpp"
#include "shelfbeam/placement/bound/row_pricing.hpp"
#include "shelfbeam/placement/bound/sparse_rows.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Multipliers, no r_j of which is negative: rows in order of length each take what their columns still have
/// (dual ascent), after a first share min_j c_j / (sum_i a_ij).
std::vector<double> ascended(const SparseRows& rows) {
  std::vector<double> total(rows.columns(), 0.0), left(rows.columns());
  for (std::uint32_t j = 0; j < rows.columns(); ++j) {
    for (const SparseRows::Term& term : rows.of_column(j)) total[j] += static_cast<double>(term.a);
    left[j] = rows.cost(j);
  }
  std::vector<double> y(rows.rows(), 0.0);
  const auto raise = [&](std::size_t i, double by) {
    if (!(by > 0) || !std::isfinite(by)) return;
    y[i] += by;
    for (const SparseRows::Term& term : rows.row(i)) left[term.index] -= by * static_cast<double>(term.a);
  };
  std::vector<double> share(rows.rows(), infinity);
  for (std::size_t i = 0; i < rows.rows(); ++i)
    for (const SparseRows::Term& term : rows.row(i))
      if (rows.rhs(i) > 0) share[i] = std::min(share[i], rows.cost(term.index) / total[term.index]);
  for (std::size_t i = 0; i < rows.rows(); ++i) raise(i, share[i]);

  for (const std::uint32_t i : ordered_by(rows.rows(), [&](auto k) { return rows.row(k).size(); })) {
    if (!(rows.rhs(i) > 0)) continue;
    double by = infinity;
    for (const SparseRows::Term& term : rows.row(i))
      by = std::min(by, left[term.index] / static_cast<double>(term.a));
    raise(i, by);
  }
  return y;
}

/// Maximises the Lagrangian dual
///
///   L(y) = sum_i y_i b_i + min over T of sum_j r_j T_j,   r_j = c_j - sum_i y_i a_ij,
///
/// by subgradient steps of Polyak's length (Beasley, Eur. J. Oper. Res. 31, 1987), deflected towards the last
/// step, with the column pricing of Caprara, Fischetti and Toth, Oper. Res. 47, 1999: steps see only the
/// core, the columns of small r_j, which is chosen anew now and then from all columns. T has at most one
/// option per mounting point. After 600 steps L is within 0.1 % of the LP bound on random covers.
class Dual {
 public:
  Dual(const SparseRows& rows, std::vector<double> start, const MultiplierBoundOptions& options,
       std::uint64_t max_steps, const RunControl& control)
      : rows_(rows),
        options_(options),
        max_steps_(max_steps),
        control_(control),
        y_(std::move(start)),
        reduced_(rows.columns(), 0.0),
        average_(rows.columns(), 0.0),
        direction_(rows.rows(), 0.0),
        best_of_group_(rows.groups(), none) {}

  /// The best multipliers.
  std::vector<double> run() {
    price_all();
    // Few steps must become short sooner.
    const std::size_t patience = std::max<std::size_t>(10, max_steps_ / 30);
    if (rows_.rows() > 0) ascend(*this, value_, {.first = 0.3, .patience = patience});
    price_all();
    return std::move(best_y_);
  }

  /// The average of recent solutions of the relaxation, one per open column.
  const std::vector<double>& average() const { return average_; }

  bool ends(std::size_t step) const {
    return step > max_steps_ || is_closed() || (step % 16 == 0 && options_.effort.is_over(control_));
  }

  double evaluate(std::size_t step) {
    if (step % pricing_period_ == 0)
      price_all();
    else
      price_core();
    if (step % 50 == 0) control_.report(Task::multipliers, -1, fmt::format("{:.6g}", best_bound_));
    return value_;
  }

  double least_gain(double value) const { return 1e-3 * std::abs(value - rows_.chosen_cost()); }

  // y_i <- max(0, y_i + length (known - L) d_i / |d|^2), d a mean of this subgradient and the last direction.
  // False at an optimum.
  bool move(double length) {
    constexpr double of_last = 0.7, of_average = 0.02;
    std::vector<double>& d = direction_;
    for (std::size_t i = 0; i < d.size(); ++i) d[i] = of_last * d[i] + (1 - of_last) * rows_.rhs(i);
    for (const std::uint32_t j : taken_)
      for (const SparseRows::Term& term : rows_.of_column(j))
        d[term.index] -= (1 - of_last) * static_cast<double>(term.a);
    for (const std::uint32_t j : core_) average_[j] *= 1 - of_average;
    for (const std::uint32_t j : taken_) average_[j] += of_average;
    double norm = 0;
    for (std::size_t i = 0; i < d.size(); ++i) {
      if (y_[i] <= 0 && d[i] < 0) d[i] = 0;
      norm += d[i] * d[i];
    }
    if (!(norm > 1e-12)) return false;
    const double above = std::max(options_.known - value_, 1e-3 * std::abs(options_.known));
    const double factor = length * above / norm;
    for (std::size_t i = 0; i < d.size(); ++i) y_[i] = std::max(0.0, y_[i] + factor * d[i]);
    return true;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  bool is_closed() const { return best_bound_ > next_better(options_.known, options_.step); }

  double reduced_cost(std::uint32_t j) const {
    double r = rows_.cost(j);
    for (const SparseRows::Term& term : rows_.of_column(j)) r -= y_[term.index] * static_cast<double>(term.a);
    return r;
  }

  auto by_reduced_cost() const {
    return [this](std::uint32_t j) { return std::pair(reduced_[j], j); };
  }

  // Chooses the core anew. Only here L is that of all columns.
  void price_all() {
    std::vector<std::uint32_t> all = all_numbers(rows_.columns());
    for (const std::uint32_t j : all) reduced_[j] = reduced_cost(j);
    solve(all);
    if (value_ > best_bound_) {
      const bool is_much = value_ > best_bound_ + 1e-3 * std::abs(value_);
      best_bound_ = value_;
      best_y_ = y_;
      pricing_period_ = is_much ? 10 : std::min<std::size_t>(2 * pricing_period_, 80);
    }
    core_ = choose_core(std::move(all));
  }

  std::vector<std::uint32_t> choose_core(std::vector<std::uint32_t> all) const {
    const std::size_t size = std::max<std::size_t>(2000, 8 * rows_.rows());
    if (all.size() <= size + size / 4) return all;
    std::ranges::nth_element(all, all.begin() + static_cast<std::ptrdiff_t>(size), {}, by_reduced_cost());
    all.resize(size);
    for (std::size_t i = 0; i < rows_.rows(); ++i) {
      const auto row = rows_.row(i);
      if (row.empty()) continue;
      all.push_back(
          std::ranges::min_element(row, {}, [&](const auto& term) { return reduced_[term.index]; })->index);
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  void price_core() {
    for (const std::uint32_t j : core_) reduced_[j] = reduced_cost(j);
    solve(core_);
  }

  // The minimum over T among these columns: at most one option per mounting point, an allowed count.
  void solve(std::span<const std::uint32_t> columns) {
    taken_.clear();
    for (const std::uint32_t j : columns) {
      const std::uint32_t g = rows_.group(j);
      if (g == SparseRows::no_group) {
        if (reduced_[j] < 0 || rows_.min_count() > 0) taken_.push_back(j);
      } else if (best_of_group_[g] == none || reduced_[j] < reduced_[best_of_group_[g]]) {
        best_of_group_[g] = j;
      }
    }
    for (std::uint32_t& j : best_of_group_) {
      if (j != none && (reduced_[j] < 0 || rows_.min_count() > 0)) taken_.push_back(j);
      j = none;
    }
    limit_count();
    value_ = rows_.chosen_cost();
    for (std::size_t i = 0; i < rows_.rows(); ++i) value_ += y_[i] * rows_.rhs(i);
    for (const std::uint32_t j : taken_) value_ += reduced_[j];
  }

  void limit_count() {
    if (rows_.min_count() == 0 && taken_.size() <= rows_.max_count()) return;
    std::ranges::sort(taken_, {}, by_reduced_cost());
    std::size_t count = 0;
    while (count < taken_.size() && count < rows_.max_count() &&
           (count < rows_.min_count() || reduced_[taken_[count]] < 0))
      ++count;
    taken_.resize(count);
  }

  const SparseRows& rows_;
  const MultiplierBoundOptions& options_;
  std::uint64_t max_steps_;
  const RunControl& control_;
  std::vector<double> best_y_, y_, reduced_, average_, direction_;
  std::vector<std::uint32_t> core_, taken_, best_of_group_;
  double value_ = -infinity, best_bound_ = -infinity;  ///< of y_ and best_y_, not yet safe against rounding
  std::size_t pricing_period_ = 10;
};

// Where linear programs take milliseconds, or rows are still to be added, few steps are enough.
constexpr std::uint64_t max_steps = 600, few_steps = 150;
constexpr std::size_t small = 50'000;  // entries
constexpr int max_rounds = 5;

class Bounding {
 public:
  Bounding(const Instance& instance, std::span<const double> cost, const MultiplierBoundOptions& options,
           const RunControl& control)
      : instance_(instance),
        cost_(cost),
        options_(options),
        control_(control),
        rows_(options.rows),
        is_row_(instance.rows(), false) {}

  MultiplierBound run() {
    if (!rows_.empty()) {
      improve(max_steps);
      return std::move(best_);
    }
    const RowPricing pricing(instance_, options_.selections.max_count);
    for (const LabelId label : pricing.hardest()) add(label);
    for (int round = 0; round < max_rounds; ++round) {
      const std::vector<double> x = improve(few_steps);
      constexpr double missed = 0.02;  // averages of few steps are no better
      const auto batch = pricing.violated(x, missed, 50 + instance_.columns() / 4, is_row_);
      if (batch.empty() || options_.effort.is_over(control_)) break;
      for (const auto& row : batch) add(row.label);
    }
    return std::move(best_);
  }

 private:
  void add(LabelId label) {
    is_row_[label] = true;
    rows_.push_back({label});
  }

  // Improves the multipliers of the present rows; returns the average solution, one per column of the table.
  std::vector<double> improve(std::uint64_t enough) {
    const SparseRows rows(instance_, cost_, options_.selections, rows_);
    if (y_.empty())
      y_ = ascended(rows);
    else
      y_.resize(rows_.size(), 0.0);
    Dual steps(rows, std::move(y_), options_,
               std::min(options_.effort.steps, rows.entries() < small ? few_steps : enough), control_);
    y_ = steps.run();
    DualBound dual = dual_bound(instance_, rows_, y_, cost_, options_.selections);
    if (best_.rows.empty() || dual.bound > best_.dual.bound) {
      best_.dual = std::move(dual);
      best_.rows.clear();
      for (std::size_t k = 0; k < rows_.size(); ++k)
        if (y_[k] > 0) best_.rows.push_back(rows_[k]);
    }
    std::vector<double> x(instance_.columns(), 0.0);
    for (const ColumnId j : rows.chosen()) x[j] = 1;
    for (std::size_t j = 0; j < rows.columns(); ++j) x[rows.column(j)] = steps.average()[j];
    return x;
  }

  const Instance& instance_;
  std::span<const double> cost_;
  const MultiplierBoundOptions& options_;
  const RunControl& control_;
  std::vector<BoundRow> rows_;
  std::vector<bool> is_row_;  ///< per label
  std::vector<double> y_;
  MultiplierBound best_;
};

}  // namespace

MultiplierBound multiplier_bound(const Instance& instance, std::span<const double> cost,
                                 const MultiplierBoundOptions& options, const RunControl& control) {
  return with_threads(control.threads, [&] { return Bounding(instance, cost, options, control).run(); });
}

}  // namespace shelfbeam::detail
