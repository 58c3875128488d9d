#include "shelfbeam/placement/bound/multiplier_bound.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/bound/row_pricing.hpp"

namespace shelfbeam::detail {

namespace {

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
    const std::size_t chosen = rows.chosen().size();
    SubgradientOptions steps;
    steps.min_count = options_.selections.min_count - std::min(options_.selections.min_count, chosen);
    steps.max_count = options_.selections.max_count - std::min(options_.selections.max_count, chosen);
    steps.known = options_.known;
    steps.step = options_.step;
    steps.effort = options_.effort;
    steps.effort.steps = std::min(options_.effort.steps, rows.entries() < small ? few_steps : enough);
    Multipliers found = subgradient(rows, std::move(y_), steps, control_);
    y_ = std::move(found.y);
    DualBound dual = dual_bound(instance_, rows_, y_, cost_, options_.selections);
    if (best_.rows.empty() || dual.bound > best_.dual.bound) {
      best_.dual = std::move(dual);
      best_.rows.clear();
      for (std::size_t k = 0; k < rows_.size(); ++k)
        if (y_[k] > 0) best_.rows.push_back(rows_[k]);
    }
    std::vector<double> x(instance_.columns(), 0.0);
    for (const ColumnId j : rows.chosen()) x[j] = 1;
    for (std::size_t j = 0; j < rows.columns(); ++j) x[rows.column(j)] = found.x[j];
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
