#include "shelfbeam/placement/windows/window_mips.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/milp/branching.hpp"
#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/bound/row_pricing.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/windows/divided_rows.hpp"

namespace shelfbeam::detail {

namespace {

struct WindowMip {
  milp::Model model;          ///< with the rows found so far
  std::vector<bool> is_done;  ///< per label: its row is in the model, or it is not near
  double bound = 0;           ///< no selection that reaches the labels costs less
  double target = 0;
  bool is_met = false;      ///< the bound is the target
  bool is_exact = false;    ///< the bound is the minimum, less the solver's gap
  bool has_failed = false;  ///< the solver has

  bool is_open() const { return !is_exact && !has_failed; }
};

class WindowMips final : ProgressSink {
 public:
  WindowMips(const Instance& instance, std::span<const double> cost, const WindowMipOptions& options,
             const milp::Backend& backend, const RunControl& control)
      : cost_(cost),
        options_(options),
        backend_(backend),
        control_(control),
        cover_(instance),
        is_sum_(instance.is_cooperative()),
        pricing_(instance, instance.columns()),
        instance_(instance) {}

  double run() {
    LpBoundOptions linear;
    linear.effort.until = options_.effort.until;
    linear.selections.without = options_.without;
    linear.rows = options_.rows;
    const LpBound lp = lp_bound(instance_, cost_, backend_, linear, control_);
    if (!lp.complete || lp.dual.bound >= options_.goal) return std::min(lp.dual.bound, options_.goal);
    divide(lp);
    with_threads(control_.threads, [&] {
      for_each_task(windows_.size(), [&](std::size_t k) { solve_linear(windows_[k]); });
      const double share = sum() > 0 ? aim() / sum() : 0;
      for (WindowMip& window : windows_) window.target = window.bound * share;
      for (double seconds = first_seconds(); !out_of_time() && sum() < options_.goal; seconds *= 2) {
        for_each_task(windows_.size(), [&](std::size_t k) {
          if (!windows_[k].is_met && windows_[k].is_open()) ask(windows_[k], seconds);
        });
        if (!raise_targets()) break;
      }
    });
    return std::max(lp.dual.bound, std::min(sum(), options_.goal));
  }

 private:
  double seconds_left() const { return options_.effort.seconds_left(); }
  bool out_of_time() const { return options_.effort.is_over(control_); }

  // Targets add up to slightly more than the goal, because bounds are lowered by the solver's tolerance.
  double aim() const { return options_.goal * (1 + 1e-5); }

  // All windows can be asked for this time within half of the time that is left.
  double first_seconds() const {
    const auto at_once = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    const std::size_t in_turn = (windows_.size() + at_once - 1) / at_once;
    return 0.5 * seconds_left() / static_cast<double>(std::max<std::size_t>(in_turn, 1));
  }

  double sum() const {
    double sum = 0;
    for (const WindowMip& window : windows_) sum += window.bound;
    return sum;
  }

  milp::Row row_of(LabelId label) const {
    milp::Row row;
    row.lower = cover_.bound(label);
    cover_.for_entries(label, [&](std::uint32_t j, double a) { row.entries.push_back({j, a}); });
    return is_sum_ ? relaxed(std::move(row)) : row;
  }

  // Windows of similar LP bounds with the rows of the LP, prices and near labels.
  void divide(const LpBound& lp) {
    constexpr double near = 0.15, rounding = 1e-12;
    std::vector<milp::Row> priced;  // times their multipliers
    for (std::size_t i = 0; i < lp.rows.size(); ++i) {
      priced.push_back(row_of(lp.rows[i].label));
      for (milp::Entry& entry : priced.back().entries) entry.value *= lp.y[i];
    }
    std::vector<double> all(cost_.size(), 0.0);
    std::vector<std::vector<double>> shares;
    const auto parts = divided_rows(priced, cost_.size(), lp.y, options_.windows);
    for (const std::vector<std::uint32_t>& part : parts) {
      std::vector<double>& share = shares.emplace_back(cost_.size(), 0.0);
      for (const std::uint32_t i : part)
        for (const milp::Entry& entry : priced[i].entries) share[entry.column] += entry.value;
      for (std::size_t j = 0; j < share.size(); ++j) all[j] += share[j];
    }
    const std::vector<bool> is_out = marked(cost_.size(), options_.without);
    for (std::size_t k = 0; k < parts.size(); ++k) {
      std::vector<double>& share = shares[k];
      WindowMip& window = windows_.emplace_back();
      for (std::uint32_t j = 0; j < share.size(); ++j) {
        share[j] = (1 - rounding) * (all[j] > 0 ? share[j] / all[j] : 1 / static_cast<double>(parts.size()));
        const bool is_chosen = instance_.is_installed(j);
        window.model.columns.push_back(
            {share[j] * cost_[j], is_chosen ? 1.0 : 0.0, is_out[j] ? 0.0 : 1.0, true, {}});
      }
      window.is_done.assign(instance_.rows(), false);
      for (std::uint32_t i = 0; i < instance_.rows(); ++i) {
        double own = 0, total = 0;
        cover_.for_entries(i, [&](std::uint32_t j, double a) {
          own += a * a * share[j];
          total += a * a;
        });
        window.is_done[i] = own < near * total;
      }
      for (const std::uint32_t i : parts[k]) {
        window.model.rows.push_back(row_of(lp.rows[i].label));
        window.is_done[lp.rows[i].label] = true;
      }
    }
  }

  // Adds rows that x violates; false if there are none.
  bool add_violated(WindowMip& window, std::span<const double> x) {
    constexpr double tolerance = 1e-6;
    constexpr std::size_t max_rows = 30;
    // One thread: waiting for others, this one would begin another window.
    const auto violated =
        with_threads(1, [&] { return pricing_.violated(x, tolerance, max_rows, window.is_done); });
    for (const RowPricing::Violated& row : violated) {
      window.model.rows.push_back(row_of(row.label));
      window.is_done[row.label] = true;
    }
    return !violated.empty();
  }

  // The LP bound of a window, and the rows that it needs.
  void solve_linear(WindowMip& window) {
    const auto lp = backend_.lp(window.model.columns);
    std::size_t loaded = 0;
    do {
      lp->add_rows(std::span(window.model.rows).subspan(loaded));
      loaded = window.model.rows.size();
      const milp::LpResult solved = lp->solve(seconds_left(), {1, control_.cancel, nullptr});
      if (solved.termination != milp::Termination::optimal) return;
      raise(window, safe_value(window.model, solved.y));
      if (!add_violated(window, solved.x)) return;
    } while (!out_of_time());
  }

  // The bound of the multipliers, summed again.
  static double safe_value(const milp::Model& model, std::span<const double> y) {
    std::vector<double> lower, upper;
    for (const milp::Column& column : model.columns) {
      lower.push_back(column.lower);
      upper.push_back(column.upper);
    }
    return milp::safe_bound(model, lower, upper, y).value;
  }

  // Asks whether the window costs more than its target.
  void ask(WindowMip& window, double seconds) {
    constexpr double gap = 1e-4;
    const Deadline deadline(std::min(seconds, seconds_left()));
    while (!deadline.has_passed() && !enough_.requested() && !control_.cancelled()) {
      const milp::Result found = backend_.solve(window.model,
                                                {.time_limit_s = deadline.seconds_left(),
                                                 .node_limit = node_limit(options_.effort),
                                                 .relative_gap = gap,
                                                 .cutoff = window.target},
                                                {1, &enough_, this});
      window.has_failed = found.termination == milp::Termination::error;
      if (window.has_failed) return;
      window.is_met = found.termination == milp::Termination::infeasible;
      raise(window, window.is_met ? window.target : std::min(found.dual_bound, window.target));
      if (found.solution.empty()) return;
      if (add_violated(window, found.solution)) continue;
      window.is_exact = found.termination == milp::Termination::optimal;
      return;
    }
  }

  // Windows that have met their targets share what the others lack; false if no window can give more.
  bool raise_targets() {
    std::vector<WindowMip*> met;
    bool is_open = false;
    for (WindowMip& window : windows_) {
      if (window.is_met) met.push_back(&window);
      is_open = is_open || window.is_open();
    }
    const double lack = aim() - sum();
    for (WindowMip* const window : met) {
      window->target += lack / static_cast<double>(met.size());
      window->is_met = false;
    }
    // With a limit on nodes, asking the same again changes nothing.
    return is_open && (!met.empty() || options_.effort.steps == any_steps);
  }

  void raise(WindowMip& window, double bound) {
    const std::lock_guard lock(mutex_);
    window.bound = std::max(window.bound, bound - milp::objective_slack(window.model, bound));
    control_.report(Task::windows, -1, fmt::format("{}, bound {:.3f}", windows_.size(), sum()));
    if (sum() >= options_.goal) enough_.request();
  }
  // Called by the solvers: a cancelled run ends them, too.
  void report(Task, double, std::string_view) override {
    if (control_.cancelled()) enough_.request();
  }

  std::span<const double> cost_;
  const WindowMipOptions& options_;
  const milp::Backend& backend_;
  const RunControl& control_;
  CoverRows cover_;
  bool is_sum_;
  RowPricing pricing_;
  const Instance& instance_;
  std::vector<WindowMip> windows_;
  std::mutex mutex_;
  CancelToken enough_;  ///< the windows add up to the goal, or the run is cancelled
};

}  // namespace

double window_mip_bound(const Instance& instance, std::span<const double> cost,
                        const WindowMipOptions& options, const milp::Backend& backend,
                        const RunControl& control) {
  return WindowMips(instance, cost, options, backend, control).run();
}

}  // namespace shelfbeam::detail
