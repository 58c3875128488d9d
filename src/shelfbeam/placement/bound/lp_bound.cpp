#include "shelfbeam/placement/bound/lp_bound.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/bound/row_pricing.hpp"
#include "shelfbeam/placement/bound/share_cuts.hpp"

namespace shelfbeam::detail {

namespace {

constexpr double row_tolerance = 1e-6;

class RowGeneration {
 public:
  RowGeneration(const Instance& instance, std::span<const double> cost, const milp::Backend& backend,
                const LpBoundOptions& options, const RunControl& control)
      : instance_(instance),
        cost_(cost),
        options_(options),
        control_(control),
        cover_(instance, options.selections.max_count),
        pricing_(instance, options.selections.max_count),
        lp_(load(instance, cost, backend, options)),
        is_row_(instance.rows(), false),
        is_out_(marked(instance.columns(), options.selections.without)) {
    result_.dual = dual_bound(instance, {}, {}, cost, options.selections);
  }

  LpBound run() {
    std::vector<BoundRow> batch = options_.rows;
    if (batch.empty())
      for (const LabelId label : pricing_.hardest()) batch.push_back({label});
    do {
      add(batch);
      if (!solve()) {
        result_.complete = false;
        break;
      }
      batch = violated_rows();
    } while (!batch.empty() && result_.dual.bound < options_.enough);
    return std::move(result_);
  }

 private:
  // A maximum count alone is left to the share cuts: as a row it could make the LP infeasible, which yields
  // no multipliers.
  static bool limits_count(const LpBoundOptions& options) { return options.selections.min_count > 0; }

  static std::unique_ptr<milp::LpSession> load(const Instance& instance, std::span<const double> cost,
                                               const milp::Backend& backend, const LpBoundOptions& options) {
    std::vector<milp::Column> columns;
    for (std::uint32_t j = 0; j < instance.columns(); ++j)
      columns.push_back({cost[j], instance.is_installed(j) ? 1.0 : 0.0, 1, false, {}});
    for (const ColumnId j : options.selections.without) columns[j].upper = 0;
    for (const ColumnId j : options.selections.with) columns[j].lower = 1;
    auto lp = backend.lp(columns);
    std::vector<milp::Row> rows;
    for (const auto& mount : instance.table.mounts) rows.push_back(milp::sum_row(mount, -milp::infinity, 1));
    if (limits_count(options))
      rows.push_back(milp::sum_row(all_numbers(instance.columns()),
                                   static_cast<double>(options.selections.min_count),
                                   static_cast<double>(options.selections.max_count)));
    if (!rows.empty()) lp->add_rows(rows);
    return lp;
  }

  void add(const std::vector<BoundRow>& batch) {
    std::vector<milp::Row> rows;
    for (const BoundRow& row : batch) {
      milp::Row& built = rows.emplace_back();
      built.lower = cover_.read(row, [&](std::uint32_t j, double a) {
        if (!is_out_[j]) built.entries.push_back({j, a});
      });
      if (row.is_plain()) {
        is_row_[row.label] = true;
        result_.labels.push_back(row.label);
      }
      rows_.push_back(row);
    }
    lp_->add_rows(rows);
  }

  bool solve() {
    if (options_.effort.seconds_left() <= 0) return false;
    milp::LpResult solved = lp_->solve(options_.effort.seconds_left(), control_);
    if (solved.termination != milp::Termination::optimal) return false;
    result_.failed = false;
    result_.x = std::move(solved.x);
    const std::size_t first_row = instance_.table.mounts.size() + (limits_count(options_) ? 1 : 0);
    std::vector<BoundRow> rows;
    std::vector<double> y;
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const double dual = solved.y[first_row + k];
      if (dual <= 0) continue;
      rows.push_back(rows_[k]);
      y.push_back(dual);
    }
    DualBound dual = dual_bound(instance_, rows, y, cost_, options_.selections);
    if (dual.bound > result_.dual.bound) {
      result_.dual = std::move(dual);
      result_.rows = std::move(rows);
      result_.y = std::move(y);
    }
    control_.report(Task::bound, -1, fmt::format("{:.6g} from {} rows", result_.dual.bound, rows_.size()));
    return true;
  }

  // Cuts are added only if no label row is violated: they cost more, and many would be useless.
  std::vector<BoundRow> violated_rows() {
    const std::size_t max_cuts = 50 + instance_.columns() / 4;
    std::vector<BoundRow> batch;
    // The LP violates its own rows by at most the solver's tolerance.
    for (const auto& row : pricing_.violated(result_.x, row_tolerance, max_cuts, is_row_))
      batch.push_back({row.label});
    result_.complete = batch.empty();
    if (batch.empty() && instance_.is_cooperative() && options_.selections.max_count < instance_.columns())
      return share_cuts(instance_, options_.selections.max_count, result_.labels, result_.x, max_cuts);
    return batch;
  }

  const Instance& instance_;
  std::span<const double> cost_;
  const LpBoundOptions& options_;
  const RunControl& control_;
  CoverRows cover_;
  RowPricing pricing_;
  std::unique_ptr<milp::LpSession> lp_;
  std::vector<BoundRow> rows_;  ///< all rows in the LP
  std::vector<bool> is_row_;    ///< per label: its row is in the LP
  std::vector<bool> is_out_;    ///< per column: SelectionSet::without
  LpBound result_;
};

}  // namespace

std::vector<BoundRow> rows_of(const LpBound& bound) {
  std::vector<BoundRow> rows;
  for (const LabelId label : bound.labels) rows.push_back({label});
  for (const BoundRow& row : bound.rows)
    if (!row.is_plain()) rows.push_back(row);
  return rows;
}

LpBound lp_bound(const Instance& instance, std::span<const double> cost, const milp::Backend& backend,
                 const LpBoundOptions& options, const RunControl& control) {
  return with_threads(control.threads,
                      [&] { return RowGeneration(instance, cost, backend, options, control).run(); });
}

}  // namespace shelfbeam::detail
