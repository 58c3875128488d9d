#include <algorithm>
#include <random>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/placement/heuristic/searches.hpp"

namespace shelfbeam::detail {

namespace {

// Rows and columns of the remainder of the reductions, numbered from 0.
struct SparseCover {
  std::vector<std::vector<std::uint32_t>> columns_of, rows_of;
  std::vector<std::uint32_t> column;  ///< number in the table

  SparseCover(const SignalTable& table, const PlacementProblem& problem, const Reduction& reduction) {
    std::vector<std::uint32_t> place(table.columns(), none);
    for (const CoverPart& part : reduction.parts) {
      if (part.labels.empty()) continue;
      for (const std::uint32_t j : part.columns) {
        place[j] = static_cast<std::uint32_t>(column.size());
        column.push_back(j);
      }
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
  CoverWalk(const SparseCover& cover, std::size_t known, std::uint32_t seed)
      : cover_(cover),
        fewest_(known),
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
    for (std::size_t c = 0; c < in_.size(); ++c)
      score_[c] = static_cast<std::int64_t>(cover.rows_of[c].size());
  }

  void run(const Effort& effort, const RunControl& control) {
    while (!open_.empty()) add(best_for(open_[random_() % open_.size()], true));
    constexpr std::uint64_t between_looks = 1024;
    std::uint32_t last = SparseCover::none;
    for (std::uint64_t move = 1; move <= effort.steps; ++move) {
      if (move % between_looks == 0) {
        if (effort.is_over(control)) return;
        control.report("local search", -1, fmt::format("{} moves", move));
      }
      now_ = move;
      while (open_.empty() || chosen_.size() >= fewest_) {
        if (open_.empty() && chosen_.size() < fewest_) {
          fewest_ = chosen_.size();
          best_ = chosen_;
        }
        if (chosen_.empty()) return;
        remove(min_useful(SparseCover::none));
      }
      if (chosen_.size() + 1 >= fewest_ && !chosen_.empty()) remove(min_useful(last));
      if (open_.empty()) continue;
      last = best_for(open_[random_() % open_.size()], false);
      if (last != SparseCover::none) add(last);
      for (const std::uint32_t i : open_) {
        ++weight_[i];
        for (const std::uint32_t c : cover_.columns_of[i]) ++score_[c];
      }
    }
  }

  Found best() const { return {best_, static_cast<double>(fewest_)}; }

 private:
  std::uint32_t best_for(std::uint32_t row, bool may_return) const {
    std::uint32_t best = SparseCover::none;
    for (const std::uint32_t c : cover_.columns_of[row]) {
      if (in_[c] || (!may_return && touched_[c] > 0 && touched_[c] + 1 >= now_)) continue;
      if (best == SparseCover::none || score_[c] > score_[best] ||
          (score_[c] == score_[best] && touched_[c] < touched_[best]))
        best = c;
    }
    return best;
  }

  // The column added last stays for a move, unless it is the only one.
  std::uint32_t min_useful(std::uint32_t last) const {
    std::uint32_t best = SparseCover::none;
    for (const std::uint32_t c : chosen_) {
      if (c == last && chosen_.size() > 1) continue;
      if (best == SparseCover::none || score_[c] < score_[best] ||
          (score_[c] == score_[best] && touched_[c] < touched_[best]))
        best = c;
    }
    return best;
  }

  // With row weights w_i and `times_` = number of chosen columns that reach row i,
  //
  //   score_j = sum of w_i over the open rows that j would reach  (j outside the selection),
  //   score_j = sum of w_i over the rows that only j reaches      (j in the selection).
  void add(std::uint32_t c) {
    in_[c] = true;
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
  std::size_t fewest_;
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

bool is_plain_cover(const SignalTable& table, const PlacementProblem& problem) {
  return problem.model == CommunicationModel::non_cooperative && !problem.redundant &&
         problem.combination == Combination::lexicographic && table.mounts.empty() && table.conflicts.empty();
}

std::optional<Selection> cover_search(const SignalTable& table, const PlacementProblem& problem,
                                      const Reduction& reduction, const Selection& start,
                                      const Effort& effort, std::uint32_t seed, const RunControl& control) {
  if (!is_plain_cover(table, problem)) return std::nullopt;
  if (reduction.infeasible || start.size() <= reduction.forced.size()) return std::nullopt;
  const SparseCover cover(table, problem, reduction);
  const auto columns = best_of_walks(seed, effort, control, [&](std::uint32_t own_seed) {
    return CoverWalk(cover, start.size() - reduction.forced.size(), own_seed);
  });
  if (!columns) return std::nullopt;
  std::vector<std::uint32_t> selected = reduction.forced;
  for (const std::uint32_t c : *columns) selected.push_back(cover.column[c]);
  std::sort(selected.begin(), selected.end());
  return selected;
}

}  // namespace shelfbeam::detail
