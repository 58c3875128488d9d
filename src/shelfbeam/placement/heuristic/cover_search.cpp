#include <algorithm>
#include <random>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/heuristic/searches.hpp"
#include "shelfbeam/placement/reduce/cover_matrix.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::uint32_t no_place = ~std::uint32_t{0};

class CoverWalk {
 public:
  CoverWalk(const CoverMatrix& cover, std::span<const std::int64_t> cost,
            std::span<const std::vector<std::uint32_t>> excludes, std::int64_t known, std::uint32_t seed)
      : cover_(cover),
        cost_(cost),
        excludes_(excludes),
        least_(known),
        in_(cost.size(), false),
        score_(cost.size(), 0),
        touched_(cost.size(), 0),
        weight_(cover.rows.size(), 1),
        times_(cover.rows.size(), 0),
        open_(all_numbers(cover.rows.size())),
        position_(open_),
        random_(seed) {
    for (std::size_t c = 0; c < in_.size(); ++c) {
      score_[c] = static_cast<std::int64_t>(cover.columns[c].size());
      per_cost_.push_back(1 / std::max(static_cast<double>(cost[c]), 1e-3));
    }
    if (!cost.empty()) min_cost_ = *std::min_element(cost.begin(), cost.end());
  }

  void run(const Effort& effort, const RunControl& control) {
    // Conflicts may keep a first selection from ever being complete.
    for (std::size_t k = 0; k < 2 * weight_.size() && !open_.empty(); ++k) {
      const std::uint32_t c = best_for(open_[random_() % open_.size()], true);
      if (c != no_place) add(c);
    }
    constexpr std::uint64_t between_looks = 1024;
    std::uint32_t last = no_place;
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
        remove(min_useful(no_place));
      }
      if (spent_ + min_cost_ >= least_ && !chosen_.empty()) remove(min_useful(last));
      if (open_.empty()) continue;
      last = best_for(open_[random_() % open_.size()], false);
      if (last != no_place) {
        add(last);
        while (spent_ >= least_ && chosen_.size() > 1) remove(min_useful(last));
      }
      for (const std::uint32_t i : open_) {
        ++weight_[i];
        for (const std::uint32_t c : cover_.rows[i]) ++score_[c];
      }
    }
  }

  // As columns of the table.
  Found best() const {
    if (!best_) return {};
    Selection selected;
    for (const std::uint32_t c : *best_) selected.push_back(cover_.column_of[c]);
    return {std::move(selected), static_cast<double>(least_)};
  }

 private:
  double value(std::uint32_t c) const { return static_cast<double>(score_[c]) * per_cost_[c]; }

  std::uint32_t best_for(std::uint32_t row, bool may_return) const {
    std::uint32_t best = no_place;
    double max_value = 0;
    for (const std::uint32_t c : cover_.rows[row]) {
      if (in_[c] || cost_[c] >= least_) continue;
      if (!may_return && touched_[c] > 0 && touched_[c] + 1 >= now_) continue;
      const double own = value(c);
      if (best != no_place && (own < max_value || (own == max_value && touched_[c] >= touched_[best])))
        continue;
      best = c;
      max_value = own;
    }
    return best;
  }

  // The column added last stays for a move, unless it is the only one.
  std::uint32_t min_useful(std::uint32_t last) const {
    std::uint32_t best = no_place;
    double min_value = 0;
    for (const std::uint32_t c : chosen_) {
      if (c == last && chosen_.size() > 1) continue;
      const double own = value(c);
      if (best != no_place && (own > min_value || (own == min_value && touched_[c] >= touched_[best])))
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
    for (const std::uint32_t other : excludes_[c])
      if (in_[other]) remove(other);
    in_[c] = true;
    spent_ += cost_[c];
    chosen_.push_back(c);
    touched_[c] = now_;
    std::int64_t alone = 0;
    for (const std::uint32_t i : cover_.columns[c]) {
      if (times_[i] == 0) {
        alone += weight_[i];
        for (const std::uint32_t other : cover_.rows[i]) score_[other] -= weight_[i];
        close(i);
      } else if (times_[i] == 1) {
        for (const std::uint32_t other : cover_.rows[i])
          if (in_[other] && other != c) score_[other] -= weight_[i];
      }
      ++times_[i];
    }
    score_[c] = alone;
  }

  void remove(std::uint32_t c) {
    in_[c] = false;
    spent_ -= cost_[c];
    chosen_.erase(std::find(chosen_.begin(), chosen_.end(), c));
    touched_[c] = now_;
    std::int64_t lost = 0;
    for (const std::uint32_t i : cover_.columns[c]) {
      if (--times_[i] == 0) {
        lost += weight_[i];
        for (const std::uint32_t other : cover_.rows[i]) score_[other] += weight_[i];
        position_[i] = static_cast<std::uint32_t>(open_.size());
        open_.push_back(i);
      } else if (times_[i] == 1) {
        for (const std::uint32_t other : cover_.rows[i])
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

  const CoverMatrix& cover_;
  std::span<const std::int64_t> cost_;
  std::span<const std::vector<std::uint32_t>> excludes_;  ///< per column: those in conflict with it
  std::int64_t least_;                                    ///< cost of the best selection
  std::int64_t spent_ = 0, min_cost_ = 0;
  std::vector<double> per_cost_;
  std::vector<bool> in_;
  std::vector<std::int64_t> score_;
  std::vector<std::uint64_t> touched_;  ///< last move that added or removed the column
  std::vector<std::int64_t> weight_;
  std::vector<std::uint32_t> times_;  ///< by row: chosen columns that reach it
  std::vector<std::uint32_t> open_, position_;
  std::vector<std::uint32_t> chosen_;
  std::optional<std::vector<std::uint32_t>> best_;
  std::mt19937 random_;
  std::uint64_t now_ = 0;
};

}  // namespace

std::optional<Selection> cover_search(const Instance& instance, const Reduction& reduction,
                                      const Selection& start, const Effort& effort, std::uint32_t seed,
                                      const RunControl& control) {
  if (reduction.infeasible) return std::nullopt;
  const bool is_weighted = instance.is_weighted();
  const auto cost_of = [&](const Selection& selected) {
    return is_weighted ? instance.cost_of(selected) : static_cast<std::int64_t>(selected.size());
  };
  const std::int64_t known = cost_of(start) - cost_of(reduction.forced);
  if (known <= 0) return std::nullopt;
  const CoverMatrix cover(instance, instance.first_cost, reduction);
  std::vector<std::uint32_t> place(instance.columns(), no_place);
  for (std::uint32_t c = 0; c < cover.column_of.size(); ++c) place[cover.column_of[c]] = c;
  std::vector<std::int64_t> cost;
  std::vector<std::vector<std::uint32_t>> excludes;
  for (const ColumnId j : cover.column_of) {
    cost.push_back(is_weighted ? instance.cost[j] : 1);
    auto& others = excludes.emplace_back();
    for (const ColumnId other : instance.excludes[j])
      if (place[other] != no_place) others.push_back(place[other]);
  }
  const auto selected = best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    return CoverWalk(cover, cost, excludes, known, own_seed);
  });
  if (!selected) return std::nullopt;
  return united(sorted(*selected), reduction.forced);
}

}  // namespace shelfbeam::detail
