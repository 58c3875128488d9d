#include "shelfbeam/placement/tree/tree_run.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

TreeRun::TreeRun(const TreeQuestion& question)
    : TreeQuestion(question),
      is_searched_(all.rows(), false),
      max_work_(limits.work > 0 ? limits.work : std::numeric_limits<std::uint64_t>::max()),
      max_cost_(goal.max_cost),
      widest_(goal.start) {
  if (goal.kind == TreeGoal::Kind::widest) {
    std::vector<float> memory;
    margin_ = margin_of(instance, all, goal.start, memory).smallest;
  }
  for (std::size_t i = 0; i < matrix.rows(); ++i) is_searched_[matrix.row(i)] = true;
}

TreeRun::TreeRun(const TreeRun& whole, std::uint64_t shares)
    : TreeQuestion(whole),
      is_searched_(whole.is_searched_),
      max_work_((whole.max_work_ - std::min(whole.max_work_, whole.work())) / shares),
      nodes_before_(whole.nodes()),
      misses_before_(whole.misses_),
      misses_(whole.misses_.load()),
      logged_(whole.logged_.load()),
      max_cost_(whole.max_cost()),
      margin_(whole.margin_.load()),
      widest_(whole.widest_),
      found_(whole.found_any()),
      cut_(whole.was_cut()) {}

void TreeRun::join(const TreeRun& part) {
  nodes_ += part.nodes();
  work_ += part.work();
  misses_ += part.misses_ - part.misses_before_;
  for (const auto& [row, number] : part.missed_) missed_[row] += number;
  is_part_cut_ = is_part_cut_ || !part.is_complete();
  std::vector<float> memory;
  if (part.best && !found_any()) offer(*part.best, memory);
}

bool TreeRun::ends() {
  constexpr std::uint64_t between_looks = 64;
  const std::uint64_t node = nodes_.fetch_add(1, std::memory_order_relaxed);
  if (work() >= max_work_) cut_.store(true, std::memory_order_relaxed);
  if (node % between_looks == 0) {
    if (node >= limits.effort.steps || misses_rows() || limits.effort.is_over(control))
      cut_.store(true, std::memory_order_relaxed);
    if (const std::unique_lock lock(reporting_, std::try_to_lock); lock.owns_lock() && control.progress)
      control.report(Task::tree_search, -1,
                     fmt::format("{} nodes, {} units", nodes_before_ + node, goal.max_units));
  }
  return was_cut() || found_any();
}

double TreeRun::exact_target() const {
  const double rule_alone = 1 - met_tolerance;
  return goal.kind == TreeGoal::Kind::cheapest
             ? rule_alone
             : std::max(rule_alone, margin_.load(std::memory_order_relaxed));
}

float TreeRun::target() const {
  constexpr double largest = 1e5;  // matrix entries are capped at ten times that
  return static_cast<float>(std::min(exact_target(), largest) * (1 - search_tolerance));
}

Margin TreeRun::offer(std::span<const ColumnId> selected, std::vector<float>& memory) {
  const Margin margin = margin_of(instance, all, selected, memory);
  count_work(all.padded_rows() * selected.size());
  if (!margin.is_met) return margin;
  const std::lock_guard lock(mutex_);
  Selection ascending = sorted(selected);
  switch (goal.kind) {
    case TreeGoal::Kind::any:
      if (found_any()) break;
      best = std::move(ascending);
      found_.store(true, std::memory_order_relaxed);
      break;
    case TreeGoal::Kind::cheapest: {
      const std::int64_t cost = instance.cost_of(selected);
      if (cost > max_cost()) break;
      best = std::move(ascending);
      max_cost_.store(cost - 1, std::memory_order_relaxed);
      break;
    }
    case TreeGoal::Kind::widest:
      if (instance.cost_of(selected) > goal.max_cost) break;
      if (const double now = margin_.load(std::memory_order_relaxed);
          margin.smallest < now ||
          (margin.smallest == now &&
           (ascending.size() > widest_.size() ||
            (ascending.size() == widest_.size() && !instance.is_first_by_id(ascending, widest_)))))
        break;
      best = widest_ = std::move(ascending);
      margin_.store(margin.smallest, std::memory_order_relaxed);
  }
  return margin;
}

void TreeRun::miss(LabelId row) {
  if (is_searched_[row]) return;
  misses_.fetch_add(1, std::memory_order_relaxed);
  const std::lock_guard lock(mutex_);
  ++missed_[row];
}

std::vector<LabelId> TreeRun::missed_rows() const {
  std::vector<LabelId> rows;
  for (const auto& [row, number] : missed_) rows.push_back(row);
  std::ranges::sort(rows, std::greater{}, [&](LabelId row) { return std::pair(missed_.at(row), row); });
  return rows;
}

}  // namespace shelfbeam::detail
