#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/bound/row_pricing.hpp"
#include "shelfbeam/placement/bound/subgradient.hpp"
#include "shelfbeam/placement/heuristic/multiplier_greedy.hpp"
#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

namespace {

// The labels of the remainder of a cover. Other problems begin with few labels and add those that the
// relaxation misses.
std::vector<BoundRow> rows_of_remainder(const Reduction& reduction) {
  std::vector<BoundRow> rows;
  for (const CoverPart& part : reduction.parts)
    for (const std::uint32_t i : part.labels) rows.push_back({i});
  return rows;
}

class Ascent {
 public:
  Ascent(SearchState& state, const Effort& effort)
      : state_(state),
        steps_(static_cast<std::size_t>(std::min<std::uint64_t>(effort.steps, max_steps))),
        until_(effort.until) {}

  void run() {
    // Every exclusion shrinks the remainder of a cover, and the bound of the remainder is better.
    for (int round = 0; round < max_rounds && !state_.is_closed(); ++round) {
      const SelectionSet open = state_.open_selections();
      if (state_.is_cover() && state_.reduction().infeasible)
        return state_.raise_open(no_limit, BoundProof::dual);
      const std::size_t before = state_.table.columns() - open.without.size();
      const DualBound dual = state_.is_cover() ? bound_of_cover(open) : bound_by_rows(open);
      state_.raise_open(dual.bound, BoundProof::dual);
      const bool excludes = state_.exclude(dual);
      if (!state_.is_cover() || !excludes || std::chrono::steady_clock::now() >= until_) return;
      const std::size_t left = state_.table.columns() - state_.open_selections().without.size();
      if (static_cast<double>(left) > enough * static_cast<double>(before)) return;
    }
  }

 private:
  static constexpr std::size_t max_steps = 600, few_steps = 150, small = 100'000;
  static constexpr int max_rounds = 4, max_row_rounds = 8;
  static constexpr double enough = 0.8, no_limit = std::numeric_limits<double>::infinity();

  DualBound bound_of_cover(const SelectionSet& open) {
    const SparseRows rows(state_.table, state_.problem, state_.first_cost, open,
                          rows_of_remainder(state_.reduction()));
    Multipliers found;
    DualBound dual = bound_of(rows, open, ascended(rows), found);
    keep(rows.bound_rows(), found.y);
    return dual;
  }

  // The rows that matter, for the next relaxation.
  void keep(const std::vector<BoundRow>& rows, const std::vector<double>& y) {
    state_.rows.clear();
    for (std::size_t k = 0; k < y.size(); ++k)
      if (y[k] > 0) state_.rows.push_back(rows[k]);
  }

  DualBound bound_by_rows(const SelectionSet& open) {
    return with_threads(state_.control.threads, [&] {
      const RowPricing pricing(state_.table, state_.problem, open.max_count);
      std::vector<bool> known(state_.table.rows(), false);
      std::vector<BoundRow> all;
      const auto add = [&](std::uint32_t label) {
        known[label] = true;
        all.push_back({label});
      };
      for (const std::uint32_t label : pricing.hardest()) add(label);
      std::vector<double> y;
      std::optional<DualBound> best;
      for (int round = 0; round < max_row_rounds; ++round) {
        const SparseRows rows(state_.table, state_.problem, state_.first_cost, open, all);
        if (round == 0)
          y = ascended(rows);
        else
          y.resize(rows.rows(), 0.0);
        Multipliers found;
        DualBound dual = bound_of(rows, open, y, found);
        y = std::move(found.y);
        if (!best || dual.bound > best->bound) best = std::move(dual);
        std::vector<double> x(state_.table.columns(), 0.0);
        for (const std::uint32_t j : rows.chosen()) x[j] = 1;
        for (std::size_t j = 0; j < rows.columns(); ++j) x[rows.column(j)] = found.x[j];
        constexpr double missed = 0.02;  // averages of few steps are no better
        const auto batch = pricing.violated(x, missed, 50 + state_.table.columns() / 4, known);
        if (batch.empty() || std::chrono::steady_clock::now() >= until_ || state_.control.cancelled()) break;
        for (const auto& row : batch) add(row.label);
      }
      keep(all, y);
      return *best;
    });
  }

  DualBound bound_of(const SparseRows& rows, const SelectionSet& open, std::vector<double> start,
                     Multipliers& found) {
    SubgradientOptions options;
    options.known = state_.incumbent.value();
    options.step = state_.bounds.step();
    // Where the linear program takes milliseconds, it does the rest.
    options.max_steps = std::min(steps_, rows.entries() < small ? few_steps : max_steps);
    options.until = until_;
    const PrimalHeuristic heuristic = [&](const Multipliers& now, std::span<const std::uint32_t> core) {
      const Selection selected = multiplier_greedy(rows, now.y, core);
      if (!selected.empty()) state_.offer(selected);
      return state_.incumbent.value();
    };
    found = subgradient(rows, std::move(start), options, heuristic, state_.control);
    return dual_bound(state_.table, state_.problem, rows.bound_rows(), found.y, state_.first_cost, open);
  }

  SearchState& state_;
  std::size_t steps_;
  std::chrono::steady_clock::time_point until_;
};

}  // namespace

void raise_bound_by_multipliers(SearchState& state, const Effort& effort) {
  Ascent(state, effort).run();
}

}  // namespace shelfbeam::detail
