#include "shelfbeam/placement/windows/window_bound.hpp"

#include <algorithm>
#include <functional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/math/steps.hpp"
#include "shelfbeam/placement/bound/ascent.hpp"
#include "shelfbeam/placement/windows/divided_rows.hpp"
#include "shelfbeam/placement/windows/window.hpp"

namespace shelfbeam::detail {

namespace {

using Windows = std::vector<Window>;

class WindowSearch {
 public:
  WindowSearch(CoverMatrix cover, double forced_cost, const WindowBoundOptions& options,
               const milp::Backend& backend, const WindowHeuristic& heuristic, const RunControl& control)
      : cover_(std::move(cover)),
        forced_cost_(forced_cost),
        options_(options),
        backend_(backend),
        heuristic_(heuristic),
        control_(control),
        target_(options.known) {
    limits_.effort.until = options.effort.until;
    limits_.control = control;
  }

  WindowBound run(std::size_t parts) {
    with_threads(control_.threads, [&] {
      // One hard window would keep all others waiting, so there are more of them if a tree is cut short.
      const std::size_t max_parts = 2 * parts;
      for (divide(parts); is_cut_short() && !is_over() && parts < max_parts;) divide(++parts);
      offer();
      keep(value_of(now_));
      length_ = first_length * std::max(0.0, target_ - best_value_);
      do {
        step_until_stuck();
        while (!is_over() && exclude()) step_until_stuck();
      } while (!is_over() && merge());
    });
    return {.bound = best_value_, .useless = sorted(useless_)};
  }

  // For ascend.
  bool ends(std::size_t) const { return is_over(); }

  double evaluate(std::size_t) {
    search(now_);
    const double value = value_of(now_);
    if (is_over() && value <= best_value_) return value;
    offer();
    keep(value);
    // Steps gain nothing while trees are cut short.
    if (is_cut_short()) allow_larger_trees(2);
    report();
    return value;
  }

  double least_gain(double value) const {
    constexpr double of_rest = 4e-3;
    return of_rest * std::max(0.0, target_ - value);
  }

  void shorten() { now_ = best_; }

  // Moves costs from windows that do without a column to those that use it, by length / |direction|^2; false
  // if they agree on all columns, so that no weights are better.
  bool move(double length) {
    constexpr double memory = 0.5;
    std::vector<double> uses(cover_.columns.size(), 0.0), count(cover_.columns.size(), 0.0);
    for (const Window& window : now_) {
      for (const std::uint32_t j : window.selected) ++uses[j];
      for (const std::uint32_t j : window.columns) ++count[j];
    }
    directions_.resize(now_.size());
    double square = 0;
    for (std::size_t w = 0; w < now_.size(); ++w) {
      const std::vector<bool> is_used = marked(cover_.columns.size(), now_[w].selected);
      directions_[w].resize(now_[w].columns.size(), 0.0);
      for (std::size_t k = 0; k < now_[w].columns.size(); ++k) {
        const std::uint32_t j = now_[w].columns[k];
        double& direction = directions_[w][k];
        direction = memory * direction + (is_used[j] ? 1 : 0) - uses[j] / count[j];
        square += direction * direction;
      }
    }
    if (!(square > 0)) return false;
    for (std::size_t w = 0; w < now_.size(); ++w)
      for (std::size_t k = 0; k < directions_[w].size(); ++k)
        now_[w].weight[k] += length / square * directions_[w][k];
    project();
    return true;
  }

 private:
  static constexpr double first_length = 0.2;

  bool is_over() const {
    return limits_.is_over() || work_ >= options_.effort.steps || best_value_ > worth();
  }

  // Max cost of selections that are better than the known ones.
  double worth() const {
    constexpr double rounding = 1e-9;
    return options_.step > 0 ? next_better(target_, options_.step) : target_ * (1 - rounding);
  }

  // Searches windows in which every row pays the same share of its columns.
  void divide(std::size_t parts) {
    now_.clear();
    for (std::vector<std::uint32_t>& rows : divided_rows(cover_, parts))
      now_.push_back(make_window(cover_, std::move(rows)));
    for (Window& window : now_) {
      std::vector<int> count(cover_.columns.size(), 0);
      for (const std::uint32_t i : window.rows)
        for (const std::uint32_t j : cover_.rows[i]) ++count[j];
      for (std::size_t k = 0; k < window.columns.size(); ++k) {
        const std::uint32_t j = window.columns[k];
        window.weight[k] = cover_.cost[j] * count[j] / static_cast<double>(cover_.columns[j].size());
      }
    }
    search(now_);
    report();
  }

  bool is_cut_short() const { return !std::ranges::all_of(now_, &Window::complete); }

  void search(Windows& windows) {
    allow_rest();
    for_each_task(windows.size(),
                  [&](std::size_t k) { search_window(cover_, windows[k], limits_, backend_); });
    for (const Window& window : windows) work_ += window.work;
  }

  // No tree exceeds the work that is left.
  void allow_rest() {
    limits_.effort.steps =
        std::min(max_nodes_, options_.effort.steps - std::min(work_, options_.effort.steps));
  }

  // Trees are cut short: larger ones are allowed, up to a size that no time suffices for.
  void allow_larger_trees(std::uint64_t growth) {
    constexpr std::uint64_t endless = std::uint64_t{1} << 50;
    max_nodes_ = std::min(endless, max_nodes_ * growth);
  }

  // The sum of the windows, less anything that they are allotted beyond the costs.
  double value_of(const Windows& windows) const {
    constexpr double rounding = 1e-9;
    double sum = forced_cost_, beyond = 0;
    std::vector<double> allotted(cover_.columns.size(), 0.0);
    for (const Window& window : windows) {
      sum += window.value;
      for (std::size_t k = 0; k < window.columns.size(); ++k) allotted[window.columns[k]] += window.weight[k];
    }
    for (std::size_t j = 0; j < allotted.size(); ++j) beyond += std::max(0.0, allotted[j] - cover_.cost[j]);
    return (1 - rounding) * sum - (1 + rounding) * beyond;
  }

  void report() const {
    control_.report(Task::windows, -1, fmt::format("{}, bound {:.3f}", now_.size(), best_value_));
  }

  void keep(double value) {
    if (!best_.empty() && !(value > best_value_)) return;
    best_value_ = value;
    best_ = now_;
  }

  void offer() {
    if (!heuristic_) return;
    std::vector<int> times(cover_.rows.size(), 0);
    std::set<std::uint32_t> all;
    for (const Window& window : now_) all.insert(window.selected.begin(), window.selected.end());
    for (const std::uint32_t j : all)
      for (const std::uint32_t i : cover_.columns[j]) ++times[i];
    std::vector<std::uint32_t> order(all.begin(), all.end());
    Selection selected;
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return cover_.cost[a] * static_cast<double>(cover_.columns[b].size()) >
             cover_.cost[b] * static_cast<double>(cover_.columns[a].size());
    });
    for (const std::uint32_t j : order) {
      const auto& rows = cover_.columns[j];
      if (std::ranges::all_of(rows, [&](std::uint32_t i) { return times[i] > 1; }))
        for (const std::uint32_t i : rows) --times[i];
      else
        selected.push_back(cover_.column_of[j]);
    }
    target_ = heuristic_(sorted(selected));
  }

  void step_until_stuck() {
    directions_.clear();
    length_ = ascend(*this, best_value_, {.first = length_, .shorter = 0.5, .patience = 4, .max_idle = 12});
  }

  // To the nearest weights that are not negative and add up to the costs.
  void project() {
    std::vector<std::vector<double*>> of_column(cover_.columns.size());
    for (Window& window : now_)
      for (std::size_t k = 0; k < window.columns.size(); ++k)
        of_column[window.columns[k]].push_back(&window.weight[k]);
    for (std::size_t j = 0; j < of_column.size(); ++j) {
      std::vector<double*>& weights = of_column[j];
      std::sort(weights.begin(), weights.end(), [](const double* a, const double* b) { return *a > *b; });
      double sum = 0, excess = 0;
      for (std::size_t k = 0; k < weights.size(); ++k) {
        sum += *weights[k];
        const double share = (sum - cover_.cost[j]) / static_cast<double>(k + 1);
        if (*weights[k] > share) excess = share;
      }
      for (double* const weight : weights) *weight = std::max(0.0, *weight - excess);
    }
  }

  struct Pair {
    double shared = 0;
    std::size_t a = 0, b = 0;
  };

  // Disjoint pairs of the best windows that share columns, the largest shared weight relative to their values
  // first: merging gains most there.
  std::vector<Pair> neighbours() const {
    std::vector<Pair> pairs;
    for (std::size_t a = 0; a < best_.size(); ++a) {
      std::vector<double> weight(cover_.columns.size(), 0.0);
      for (std::size_t k = 0; k < best_[a].columns.size(); ++k)
        weight[best_[a].columns[k]] = best_[a].weight[k];
      for (std::size_t b = a + 1; b < best_.size(); ++b) {
        double shared = 0;
        for (std::size_t k = 0; k < best_[b].columns.size(); ++k)
          shared += std::min(best_[b].weight[k], weight[best_[b].columns[k]]);
        if (shared > 0) pairs.push_back({shared / (best_[a].value + best_[b].value), a, b});
      }
    }
    std::ranges::stable_sort(pairs, std::greater{}, &Pair::shared);
    std::vector<bool> is_taken(best_.size(), false);
    std::erase_if(pairs, [&](const Pair& pair) {
      if (is_taken[pair.a] || is_taken[pair.b]) return true;
      is_taken[pair.a] = is_taken[pair.b] = true;
      return false;
    });
    return pairs;
  }

  // Excludes columns that no better selection contains; true if there are any.
  bool exclude() {
    constexpr double hopeful = 0.5;  // of the difference that makes a selection better
    const double allowance = worth() - value_of(best_);
    if (!(options_.step > 0) || allowance > hopeful * options_.step) return false;
    std::vector<std::vector<std::uint32_t>> useless(best_.size());
    allow_rest();
    for_each_task(best_.size(), [&](std::size_t k) {
      useless[k] = examine_columns(cover_, best_[k], allowance, limits_, backend_);
    });
    std::vector<bool> is_removed(cover_.columns.size(), false);
    for (const Window& window : best_) work_ += window.work;
    for (const auto& columns : useless)
      for (const std::uint32_t j : columns) is_removed[j] = true;
    const std::vector<std::uint32_t> removed = numbers_where(is_removed);
    if (removed.empty()) return false;
    for (const std::uint32_t j : removed) useless_.push_back(cover_.column_of[j]);
    remove_columns(cover_, is_removed);
    for (Window& window : best_) remove_columns(window, is_removed);
    if (std::ranges::any_of(cover_.rows, [](const auto& row) { return row.empty(); })) {
      best_value_ = std::numeric_limits<double>::infinity();
      return true;
    }
    now_ = best_;
    search(now_);
    keep(value_of(now_));
    length_ *= 4;
    return true;
  }

  // Merges pairs of neighbours whose common tree is small enough; larger trees are allowed as long as there
  // is none. False if no neighbours are left.
  bool merge() {
    const std::vector<Pair> pairs = neighbours();
    while (!pairs.empty() && !is_over()) {
      Windows both;
      for (const Pair& pair : pairs) both.push_back(merged(cover_, best_[pair.a], best_[pair.b]));
      search(both);
      Windows next;
      std::vector<bool> is_merged(best_.size(), false);
      for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (!both[k].complete) continue;
        is_merged[pairs[k].a] = is_merged[pairs[k].b] = true;
        next.push_back(std::move(both[k]));
      }
      if (next.empty()) {
        allow_larger_trees(4);
        continue;
      }
      for (std::size_t w = 0; w < best_.size(); ++w)
        if (!is_merged[w]) next.push_back(std::move(best_[w]));
      now_ = best_ = std::move(next);
      best_value_ = std::max(best_value_, value_of(best_));  // equal windows may lose their rounding errors
      length_ *= 4;
      return true;
    }
    return false;
  }

  CoverMatrix cover_;
  double forced_cost_;
  const WindowBoundOptions& options_;
  const milp::Backend& backend_;
  const WindowHeuristic& heuristic_;
  const RunControl& control_;
  double target_;  ///< cost of the best selection known
  Windows now_, best_;
  std::vector<ColumnId> useless_;
  double best_value_ = 0, length_ = 0;
  std::vector<std::vector<double>> directions_;  ///< per window and column, mean of recent steps
  std::uint64_t max_nodes_ = 50'000, work_ = 0;
  CoverTreeLimits limits_;
};

}  // namespace

WindowBound window_bound(const Instance& instance, std::span<const double> cost, const Reduction& reduction,
                         const WindowBoundOptions& options, const milp::Backend& backend,
                         const WindowHeuristic& heuristic, const RunControl& control) {
  double forced_cost = 0;
  for (const std::uint32_t j : reduction.forced) forced_cost += cost[j];
  const WindowHeuristic whole = [&](const Selection& selected) {
    return heuristic(united(selected, reduction.forced));
  };
  CoverMatrix cover(instance, cost, reduction);
  if (cover.rows.empty()) return {.bound = forced_cost, .useless = {}};
  return WindowSearch(std::move(cover), forced_cost, options, backend, heuristic ? whole : heuristic, control)
      .run(options.windows);
}

}  // namespace shelfbeam::detail
