#include "shelfbeam/placement/windows/window.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "shelfbeam/placement/windows/cover_tree.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::uint32_t none = ~std::uint32_t{0};

// Multipliers of the rows: the LP's, or none if it fails.
std::vector<double> lp_multipliers(const SmallCover& cover, const milp::Backend& backend) {
  std::vector<milp::Column> columns;
  for (const double cost : cover.cost) columns.push_back({cost, 0, 1, false, {}});
  std::vector<milp::Row> rows;
  for (const auto& members : cover.rows) {
    milp::Row& row = rows.emplace_back();
    row.lower = 1;
    for (const std::uint32_t j : members) row.entries.push_back({j, 1.0});
  }
  const auto lp = backend.lp(columns);
  lp->add_rows(rows);
  return lp->solve(milp::infinity, {}).y;
}

// Rows that the selection does not reach yet are reached by columns without weight.
void add_free_columns(const CoverMatrix& cover, const std::vector<bool>& is_free, Window& window) {
  std::vector<bool> is_open(cover.rows.size(), false);
  for (const std::uint32_t i : window.rows) is_open[i] = true;
  const auto reach = [&](std::uint32_t j) {
    for (const std::uint32_t i : cover.columns[j]) is_open[i] = false;
  };
  for (const std::uint32_t j : window.selected) reach(j);
  for (const std::uint32_t i : window.rows) {
    if (!is_open[i]) continue;
    std::size_t most = 0;
    std::uint32_t best = none;
    for (const std::uint32_t j : cover.rows[i]) {
      if (!is_free[j]) continue;
      const auto& rows = cover.columns[j];
      const auto gain = static_cast<std::size_t>(
          std::count_if(rows.begin(), rows.end(), [&](std::uint32_t k) { return is_open[k]; }));
      if (gain > most) most = gain, best = j;
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
  for (std::uint32_t j = 0; j < is_in.size(); ++j)
    if (is_in[j]) window.columns.push_back(j);
  window.weight.assign(window.columns.size(), 0.0);
  return window;
}

Window merged(const CoverMatrix& cover, const Window& a, const Window& b) {
  std::vector<std::uint32_t> rows;
  std::merge(a.rows.begin(), a.rows.end(), b.rows.begin(), b.rows.end(), std::back_inserter(rows));
  Window window = make_window(cover, std::move(rows));
  std::vector<double> sum(cover.columns.size(), 0.0);
  for (const Window* part : {&a, &b})
    for (std::size_t k = 0; k < part->columns.size(); ++k) sum[part->columns[k]] += part->weight[k];
  for (std::size_t k = 0; k < window.columns.size(); ++k) window.weight[k] = sum[window.columns[k]];
  std::set_union(a.selected.begin(), a.selected.end(), b.selected.begin(), b.selected.end(),
                 std::back_inserter(window.selected));
  return window;
}

void search_window(const CoverMatrix& cover, Window& window, std::uint64_t max_nodes,
                   const milp::Backend& backend, const std::function<bool()>& stop) {
  // Columns that weigh next to nothing count as free.
  constexpr double next_to_nothing = 1e-6;
  std::vector<bool> is_free(cover.columns.size(), false), is_reached(cover.rows.size(), false);
  std::vector<std::uint32_t> place(cover.columns.size(), none), columns;
  SmallCover small;
  std::vector<bool> was_selected(cover.columns.size(), false);
  for (const std::uint32_t j : window.selected) was_selected[j] = true;
  double known = 0;
  for (std::size_t k = 0; k < window.columns.size(); ++k) {
    const std::uint32_t j = window.columns[k];
    is_free[j] = window.weight[k] <= next_to_nothing * cover.cost[j];
    if (is_free[j]) {
      for (const std::uint32_t i : cover.columns[j]) is_reached[i] = true;
    } else {
      place[j] = static_cast<std::uint32_t>(columns.size());
      columns.push_back(j);
      small.cost.push_back(window.weight[k]);
      if (window.selected.empty() || was_selected[j]) known += window.weight[k];
    }
  }
  for (const std::uint32_t i : window.rows) {
    if (is_reached[i]) continue;
    std::vector<std::uint32_t>& row = small.rows.emplace_back();
    for (const std::uint32_t j : cover.rows[i]) row.push_back(place[j]);
  }
  // The old selection is still one, and is found again if it is the cheapest.
  constexpr double slightly_more = 1 + 1e-6;
  const std::vector<double> y = small.rows.empty() ? std::vector<double>{} : lp_multipliers(small, backend);
  const CheapestCover found =
      cheapest_cover(small, y, {.known = known * slightly_more, .max_nodes = max_nodes, .stop = stop});
  window.value = found.bound;
  window.complete = found.complete;
  window.nodes = found.nodes;
  if (!found.selected && !small.rows.empty()) return;
  window.selected.clear();
  if (found.selected)
    for (const std::uint32_t k : *found.selected) window.selected.push_back(columns[k]);
  add_free_columns(cover, is_free, window);
}

}  // namespace shelfbeam::detail
