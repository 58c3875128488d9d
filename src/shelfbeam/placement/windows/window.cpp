#include "shelfbeam/placement/windows/window.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};
constexpr std::uint64_t work_of_lp = 1000;

// A window without its free columns, which weigh next to nothing, and without the rows that they reach.
struct SmallWindow {
  SmallCover cover;
  std::vector<std::uint32_t> columns;  ///< of the whole cover
  std::vector<bool> is_free;

  SmallWindow(const CoverMatrix& whole, const Window& window) : is_free(whole.columns.size(), false) {
    constexpr double next_to_nothing = 1e-6;
    std::vector<bool> is_reached(whole.rows.size(), false);
    std::vector<std::uint32_t> place(whole.columns.size(), none);
    for (std::size_t k = 0; k < window.columns.size(); ++k) {
      const std::uint32_t j = window.columns[k];
      is_free[j] = window.weight[k] <= next_to_nothing * whole.cost[j];
      if (is_free[j]) {
        for (const std::uint32_t i : whole.columns[j]) is_reached[i] = true;
        continue;
      }
      place[j] = static_cast<std::uint32_t>(columns.size());
      columns.push_back(j);
      cover.cost.push_back(window.weight[k]);
    }
    for (const std::uint32_t i : window.rows) {
      if (is_reached[i]) continue;
      std::vector<std::uint32_t>& row = cover.rows.emplace_back();
      for (const std::uint32_t j : whole.rows[i]) row.push_back(place[j]);
    }
  }
};

// Multipliers of the rows: the LP's, or none if it fails.
std::vector<double> lp_multipliers(const SmallCover& cover, const CoverTreeLimits& limits,
                                   const milp::Backend& backend) {
  if (cover.rows.empty()) return {};
  std::vector<milp::Column> columns;
  for (const double cost : cover.cost) columns.push_back({cost, 0, 1, false, {}});
  std::vector<milp::Row> rows;
  for (const auto& row : cover.rows) rows.push_back(milp::sum_row(row, 1, milp::infinity));
  const auto lp = backend.lp(columns);
  lp->add_rows(rows);
  return lp->solve(limits.effort.seconds_left(), {1, limits.control.cancel, nullptr}).y;
}

// Rows that the selection does not reach yet are reached by columns without weight.
void add_free_columns(const CoverMatrix& cover, const std::vector<bool>& is_free, Window& window) {
  std::vector<bool> is_open = marked(cover.rows.size(), window.rows);
  const auto reach = [&](std::uint32_t j) {
    for (const std::uint32_t i : cover.columns[j]) is_open[i] = false;
  };
  for (const std::uint32_t j : window.selected) reach(j);
  for (const std::uint32_t i : window.rows) {
    if (!is_open[i]) continue;
    std::ptrdiff_t max_gain = 0;
    std::uint32_t best = none;
    for (const std::uint32_t j : cover.rows[i]) {
      if (!is_free[j]) continue;
      const auto gain = std::ranges::count_if(cover.columns[j], [&](std::uint32_t k) { return is_open[k]; });
      if (gain <= max_gain) continue;
      max_gain = gain;
      best = j;
    }
    reach(best);
    window.selected.push_back(best);
  }
  std::sort(window.selected.begin(), window.selected.end());
}

}  // namespace

Window make_window(const CoverMatrix& cover, std::vector<std::uint32_t> rows) {
  Window window;
  window.rows = std::move(rows);
  std::vector<bool> is_in(cover.columns.size(), false);
  for (const std::uint32_t i : window.rows)
    for (const std::uint32_t j : cover.rows[i]) is_in[j] = true;
  window.columns = numbers_where(is_in);
  window.weight.assign(window.columns.size(), 0.0);
  return window;
}

Window merged(const CoverMatrix& cover, const Window& a, const Window& b) {
  Window window = make_window(cover, united(a.rows, b.rows));
  std::vector<double> sum(cover.columns.size(), 0.0);
  for (const Window* part : {&a, &b})
    for (std::size_t k = 0; k < part->columns.size(); ++k) sum[part->columns[k]] += part->weight[k];
  for (std::size_t k = 0; k < window.columns.size(); ++k) window.weight[k] = sum[window.columns[k]];
  if (!a.selected.empty() && !b.selected.empty()) window.selected = united(a.selected, b.selected);
  return window;
}

void search_window(const CoverMatrix& cover, Window& window, const CoverTreeLimits& limits,
                   const milp::Backend& backend) {
  const SmallWindow small(cover, window);
  double known = 0;
  const std::vector<bool> was_selected = marked(cover.columns.size(), window.selected);
  for (std::size_t k = 0; k < small.columns.size(); ++k)
    if (window.selected.empty() || was_selected[small.columns[k]]) known += small.cover.cost[k];
  // The old selection is still one, and is found again if it is the cheapest.
  constexpr double slightly_more = 1 + 1e-6;
  const FoundCovers found = cheapest_cover(small.cover, lp_multipliers(small.cover, limits, backend),
                                           known * slightly_more, limits);
  window.value = found.bound;
  window.complete = found.complete;
  window.work = work_of_lp + found.nodes;
  if (!found.selected && !small.cover.rows.empty()) return;
  window.selected.clear();
  if (found.selected)
    for (const std::uint32_t k : *found.selected) window.selected.push_back(small.columns[k]);
  add_free_columns(cover, small.is_free, window);
}

std::vector<std::uint32_t> examine_columns(const CoverMatrix& cover, Window& window, double allowance,
                                           const CoverTreeLimits& limits, const milp::Backend& backend) {
  const SmallWindow small(cover, window);
  const FoundCovers found = columns_of_covers(small.cover, lp_multipliers(small.cover, limits, backend),
                                              window.value + allowance, limits);
  window.work = work_of_lp + found.nodes;
  std::vector<std::uint32_t> useless;
  for (std::size_t k = 0; k < small.columns.size(); ++k)
    if (!found.contains[k]) useless.push_back(small.columns[k]);
  return useless;
}

void remove_columns(CoverMatrix& cover, const std::vector<bool>& is_removed) {
  for (auto& row : cover.rows) std::erase_if(row, [&](std::uint32_t j) { return is_removed[j]; });
  for (std::size_t j = 0; j < is_removed.size(); ++j)
    if (is_removed[j]) cover.columns[j].clear();
}

void remove_columns(Window& window, const std::vector<bool>& is_removed) {
  std::size_t left = 0;
  for (std::size_t k = 0; k < window.columns.size(); ++k) {
    if (is_removed[window.columns[k]]) continue;
    window.columns[left] = window.columns[k];
    window.weight[left++] = window.weight[k];
  }
  window.columns.resize(left);
  window.weight.resize(left);
  if (std::ranges::any_of(window.selected, [&](std::uint32_t j) { return is_removed[j]; })) {
    window.selected.clear();
    window.complete = false;
  }
}

}  // namespace shelfbeam::detail
