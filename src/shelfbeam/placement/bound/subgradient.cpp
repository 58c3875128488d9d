#include "shelfbeam/placement/bound/subgradient.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/steps.hpp"
#include "shelfbeam/placement/bound/ascent.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

class Dual {
 public:
  Dual(const SparseRows& rows, std::vector<double> start, const SubgradientOptions& options,
       const RunControl& control)
      : rows_(rows),
        options_(options),
        control_(control),
        reduced_(rows.columns(), 0.0),
        average_(rows.columns(), 0.0),
        direction_(rows.rows(), 0.0),
        best_of_group_(rows.groups(), none) {
    y_ = std::move(start);
    best_.bound = -infinity;
  }

  Multipliers run() {
    price_all();
    // Few steps must become short sooner.
    const std::size_t patience = std::max<std::size_t>(10, options_.effort.steps / 30);
    if (rows_.rows() > 0) ascend(*this, value_, {.first = 0.3, .patience = patience});
    price_all();
    best_.x = average_;
    return best_;
  }

  bool ends(std::size_t step) const {
    return step > options_.effort.steps || is_closed() ||
           (step % 16 == 0 && options_.effort.is_over(control_));
  }

  double evaluate(std::size_t step) {
    if (step % pricing_period_ == 0)
      price_all();
    else
      price_core();
    if (step % 50 == 0) control_.report(Task::multipliers, -1, fmt::format("{:.6g}", best_.bound));
    return value_;
  }

  static double least_gain(double value) { return 1e-3 * std::abs(value); }

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

  bool is_closed() const { return best_.bound > next_better(options_.known, options_.step); }

  double reduced_cost(std::uint32_t j) const {
    double r = rows_.cost(j);
    for (const SparseRows::Term& term : rows_.of_column(j)) r -= y_[term.index] * static_cast<double>(term.a);
    return r;
  }

  // Chooses the core anew. Only here L is that of all columns.
  void price_all() {
    std::vector<std::uint32_t> all(rows_.columns());
    std::iota(all.begin(), all.end(), 0U);
    for (const std::uint32_t j : all) reduced_[j] = reduced_cost(j);
    solve(all);
    if (value_ > best_.bound) {
      const bool is_much = value_ > best_.bound + 1e-3 * std::abs(value_);
      best_.bound = value_;
      best_.y = y_;
      best_.reduced = reduced_;
      pricing_period_ = is_much ? 10 : std::min<std::size_t>(2 * pricing_period_, 80);
    }
    core_ = choose_core(std::move(all));
  }

  std::vector<std::uint32_t> choose_core(std::vector<std::uint32_t> all) const {
    const std::size_t size = std::max<std::size_t>(2000, 8 * rows_.rows());
    if (all.size() <= size + size / 4) return all;
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(size), all.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return reduced_[a] != reduced_[b] ? reduced_[a] < reduced_[b] : a < b;
                     });
    all.resize(size);
    for (std::size_t i = 0; i < rows_.rows(); ++i) {
      const auto row = rows_.row(i);
      if (row.empty()) continue;
      all.push_back(std::min_element(row.begin(), row.end(), [&](const auto& a, const auto& b) {
                      return reduced_[a.index] < reduced_[b.index];
                    })->index);
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
        if (reduced_[j] < 0 || options_.min_count > 0) taken_.push_back(j);
      } else if (best_of_group_[g] == none || reduced_[j] < reduced_[best_of_group_[g]]) {
        best_of_group_[g] = j;
      }
    }
    for (std::uint32_t& j : best_of_group_) {
      if (j != none && (reduced_[j] < 0 || options_.min_count > 0)) taken_.push_back(j);
      j = none;
    }
    limit_count();
    value_ = rows_.chosen_cost();
    for (std::size_t i = 0; i < rows_.rows(); ++i) value_ += y_[i] * rows_.rhs(i);
    for (const std::uint32_t j : taken_) value_ += reduced_[j];
  }

  void limit_count() {
    if (options_.min_count == 0 && taken_.size() <= options_.max_count) return;
    std::sort(taken_.begin(), taken_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return reduced_[a] != reduced_[b] ? reduced_[a] < reduced_[b] : a < b;
    });
    std::size_t count = 0;
    while (count < taken_.size() && count < options_.max_count &&
           (count < options_.min_count || reduced_[taken_[count]] < 0))
      ++count;
    taken_.resize(count);
  }

  const SparseRows& rows_;
  const SubgradientOptions& options_;
  const RunControl& control_;
  Multipliers best_;
  std::vector<double> y_, reduced_, average_, direction_;
  std::vector<std::uint32_t> core_, taken_, best_of_group_;
  double value_ = -infinity;
  std::size_t pricing_period_ = 10;
};

}  // namespace

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

  std::vector<std::uint32_t> order(rows.rows());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return rows.row(a).size() < rows.row(b).size(); });
  for (const std::uint32_t i : order) {
    if (!(rows.rhs(i) > 0)) continue;
    double by = infinity;
    for (const SparseRows::Term& term : rows.row(i))
      by = std::min(by, left[term.index] / static_cast<double>(term.a));
    raise(i, by);
  }
  return y;
}

Multipliers subgradient(const SparseRows& rows, std::vector<double> start, const SubgradientOptions& options,
                        const RunControl& control) {
  return Dual(rows, std::move(start), options, control).run();
}

}  // namespace shelfbeam::detail
