#include <algorithm>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/placement/heuristic/searches.hpp"

namespace shelfbeam::detail {

namespace {

// Rows and columns of the remainder of the reductions, numbered from 0. Columns in conflict with forced ones
// are omitted.
struct SparseCover {
  std::vector<std::vector<std::uint32_t>> columns_of, rows_of;
  std::vector<std::vector<std::uint32_t>> excludes;  ///< by column: those in conflict with it
  std::vector<std::int64_t> cost;                    ///< 1 if units are counted
  std::vector<std::uint32_t> column;                 ///< number in the table

  SparseCover(const Instance& instance, const Reduction& reduction) {
    const SignalTable& table = instance.table;
    const PlacementProblem& problem = instance.problem;
    const bool is_weighted = problem.combination == Combination::weighted;
    std::vector<bool> is_out(table.columns(), false);
    for (const std::uint32_t j : reduction.forced)
      for (const std::uint32_t other : instance.excludes[j]) is_out[other] = true;
    std::vector<std::uint32_t> place(table.columns(), none);
    for (const CoverPart& part : reduction.parts) {
      if (part.labels.empty()) continue;
      for (const std::uint32_t j : part.columns) {
        if (is_out[j]) continue;
        place[j] = static_cast<std::uint32_t>(column.size());
        column.push_back(j);
        cost.push_back(is_weighted ? instance.cost[j] : 1);
      }
    }
    for (const std::uint32_t j : column) {
      auto& others = excludes.emplace_back();
      for (const std::uint32_t other : instance.excludes[j])
        if (place[other] != none) others.push_back(place[other]);
    }
    rows_of.resize(column.size());
    for (const CoverPart& part : reduction.parts) {
      for (const std::uint32_t i : part.labels) {
        const auto row = static_cast<std::uint32_t>(columns_of.size());
        auto& columns = columns_of.emplace_back();
        const double requirement = requirement_of(table.labels[i], problem.model);
        for (const SignalEntry& entry : table.row(i)) {
          const std::uint32_t c = place[entry.transceiver];
          if (c == none || !is_met(entry.signal, requirement)) continue;
          columns.push_back(c);
          rows_of[c].push_back(row);
        }
      }
    }
  }

  static constexpr std::uint32_t none = ~std::uint32_t{0};
};

class CoverWalk {
 public:
  CoverWalk(const SparseCover& cover, std::int64_t known, std::uint32_t seed)
      : cover_(cover),
        least_(known),
        in_(cover.column.size(), false),
        score_(cover.column.size(), 0),
        touched_(cover.column.size(), 0),
        weight_(cover.columns_of.size(), 1),
        times_(cover.columns_of.size(), 0),
        position_(cover.columns_of.size(), 0),
        random_(seed) {
    for (std::uint32_t i = 0; i < weight_.size(); ++i) {
      position_[i] = static_cast<std::uint32_t>(open_.size());
      open_.push_back(i);
    }
    for (std::size_t c = 0; c < in_.size(); ++c) {
      score_[c] = static_cast<std::int64_t>(cover.rows_of[c].size());
      per_cost_.push_back(1 / std::max(static_cast<double>(cover.cost[c]), 1e-3));
    }
    if (!cover.cost.empty()) min_cost_ = *std::min_element(cover.cost.begin(), cover.cost.end());
  }

  void run(const Effort& effort, const RunControl& control) {
    // Conflicts may keep a first selection from ever being complete.
    for (std::size_t k = 0; k < 2 * weight_.size() && !open_.empty(); ++k) {
      const std::uint32_t c = best_for(open_[random_() % open_.size()], true);
      if (c != SparseCover::none) add(c);
    }
    constexpr std::uint64_t between_looks = 1024;
    std::uint32_t last = SparseCover::none;
    for (std::uint64_t move = 1; move <= effort.steps; ++move) {
      if (move % between_looks == 0) {
        if (effort.is_over(control)) return;
        control.report(Task::local_search, -1, fmt::format("{} moves", move));
      }
      now_ = move;
      while (open_.empty() || spent_ >= least_) {
        if (open_.empty() && spent_ < least_) {
          least_ = spent_;
          best_ = chosen_;
        }
        if (chosen_.empty()) return;
        remove(min_useful(SparseCover::none));
      }
      if (spent_ + min_cost_ >= least_ && !chosen_.empty()) remove(min_useful(last));
      if (open_.empty()) continue;
      last = best_for(open_[random_() % open_.size()], false);
      if (last != SparseCover::none) {
        add(last);
        while (spent_ >= least_ && chosen_.size() > 1) remove(min_useful(last));
      }
      for (const std::uint32_t i : open_) {
        ++weight_[i];
        for (const std::uint32_t c : cover_.columns_of[i]) ++score_[c];
      }
    }
  }

  Found best() const { return {best_, static_cast<double>(least_)}; }

 private:
  double value(std::uint32_t c) const { return static_cast<double>(score_[c]) * per_cost_[c]; }

  std::uint32_t best_for(std::uint32_t row, bool may_return) const {
    std::uint32_t best = SparseCover::none;
    double max_value = 0;
    for (const std::uint32_t c : cover_.columns_of[row]) {
      if (in_[c] || cover_.cost[c] >= least_) continue;
      if (!may_return && touched_[c] > 0 && touched_[c] + 1 >= now_) continue;
      const double own = value(c);
      if (best != SparseCover::none &&
          (own < max_value || (own == max_value && touched_[c] >= touched_[best])))
        continue;
      best = c;
      max_value = own;
    }
    return best;
  }

  // The column added last stays for a move, unless it is the only one.
  std::uint32_t min_useful(std::uint32_t last) const {
    std::uint32_t best = SparseCover::none;
    double min_value = 0;
    for (const std::uint32_t c : chosen_) {
      if (c == last && chosen_.size() > 1) continue;
      const double own = value(c);
      if (best != SparseCover::none &&
          (own > min_value || (own == min_value && touched_[c] >= touched_[best])))
        continue;
      best = c;
      min_value = own;
    }
    return best;
  }

  // With row weights w_i and `times_` = number of chosen columns that reach row i,
  //
  //   score_j = sum of w_i over the open rows that j would reach  (j outside the selection),
  //   score_j = sum of w_i over the rows that only j reaches      (j in the selection).
  void add(std::uint32_t c) {
    for (const std::uint32_t other : cover_.excludes[c])
      if (in_[other]) remove(other);
    in_[c] = true;
    spent_ += cover_.cost[c];
    chosen_.push_back(c);
    touched_[c] = now_;
    std::int64_t alone = 0;
    for (const std::uint32_t i : cover_.rows_of[c]) {
      if (times_[i] == 0) {
        alone += weight_[i];
        for (const std::uint32_t other : cover_.columns_of[i]) score_[other] -= weight_[i];
        close(i);
      } else if (times_[i] == 1) {
        for (const std::uint32_t other : cover_.columns_of[i])
          if (in_[other] && other != c) score_[other] -= weight_[i];
      }
      ++times_[i];
    }
    score_[c] = alone;
  }

  void remove(std::uint32_t c) {
    in_[c] = false;
    spent_ -= cover_.cost[c];
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), c));
    touched_[c] = now_;
    std::int64_t lost = 0;
    for (const std::uint32_t i : cover_.rows_of[c]) {
      if (--times_[i] == 0) {
        lost += weight_[i];
        for (const std::uint32_t other : cover_.columns_of[i]) score_[other] += weight_[i];
        position_[i] = static_cast<std::uint32_t>(open_.size());
        open_.push_back(i);
      } else if (times_[i] == 1) {
        for (const std::uint32_t other : cover_.columns_of[i])
          if (in_[other]) score_[other] += weight_[i];
      }
    }
    score_[c] = lost;
  }

  void close(std::uint32_t row) {
    const std::uint32_t at = position_[row];
    open_[at] = open_.back();
    position_[open_[at]] = at;
    open_.pop_back();
  }

  const SparseCover& cover_;
  std::int64_t least_;  ///< cost of the best selection
  std::int64_t spent_ = 0, min_cost_ = 0;
  std::vector<double> per_cost_;
  std::vector<bool> in_;
  std::vector<std::int64_t> score_;
  std::vector<std::uint64_t> touched_;  ///< last move that added or removed the column
  std::vector<std::int64_t> weight_;
  std::vector<std::uint32_t> times_;  ///< by row: chosen columns that reach it
  std::vector<std::uint32_t> open_, position_;
  std::vector<std::uint32_t> chosen_;
  std::optional<Selection> best_;
  std::mt19937 random_;
  std::uint64_t now_ = 0;
};

}  // namespace

std::optional<Selection> cover_search(const Instance& instance, const Reduction& reduction,
                                      const Selection& start, const Effort& effort, std::uint32_t seed,
                                      const RunControl& control) {
  if (reduction.infeasible) return std::nullopt;
  const bool is_weighted = instance.problem.combination == Combination::weighted;
  const auto cost_of = [&](const Selection& selected) {
    return is_weighted ? instance.cost_of(selected) : static_cast<std::int64_t>(selected.size());
  };
  const std::int64_t known = cost_of(start) - cost_of(reduction.forced);
  if (known <= 0) return std::nullopt;
  const SparseCover cover(instance, reduction);
  const auto columns = best_of_walks(
      seed, effort, control, [&](std::uint32_t own_seed) { return CoverWalk(cover, known, own_seed); });
  if (!columns) return std::nullopt;
  Selection selected = reduction.forced;
  for (const std::uint32_t c : *columns) selected.push_back(cover.column[c]);
  std::sort(selected.begin(), selected.end());
  return selected;
}

}  // namespace shelfbeam::detail
