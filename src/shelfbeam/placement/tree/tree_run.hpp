#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/tree/tree_search.hpp"

namespace shelfbeam::detail {

/// The question of one tree search.
struct TreeQuestion {
  const Instance& instance;
  const SearchMatrix& all;
  const SearchMatrix& matrix;  ///< the rows of the search
  const TreeGoal& goal;
  const TreeSearch::Limits& limits;
  const RunControl& control;
  Receiving rule = receiving(instance.problem);
};

/// State shared by the walks of one tree search.
class TreeRun : public TreeQuestion {
 public:
  explicit TreeRun(const TreeQuestion& question);

  /// A part of `whole`: starts from the present state, keeps its findings to itself, and has the share 1 /
  /// `shares` of the remaining work.
  TreeRun(const TreeRun& whole, std::uint64_t shares);
  /// Adds the findings of a part.
  void join(const TreeRun& part);

  /// Counts a node; true if the search ends here, by a limit or because `any` is found.
  bool ends();
  /// Counts matrix cells that were examined.
  void count_work(std::uint64_t entries) { work_.fetch_add(entries, std::memory_order_relaxed); }
  /// The minimum margin of an acceptable selection; lowered for single precision in `target`.
  float target() const;
  double exact_target() const;
  std::int64_t max_cost() const { return max_cost_.load(std::memory_order_relaxed); }

  /// Checks a selection that meets the search's rows on all rows; keeps it if it is the best. Returns its
  /// margin.
  Margin offer(std::span<const ColumnId> selected, std::vector<float>& memory);
  /// Counts a miss of a row that the search does not contain.
  void miss(LabelId row);
  /// Enough misses for a restart with the missed rows.
  bool misses_rows() const { return misses_.load(std::memory_order_relaxed) > max_misses; }
  std::vector<LabelId> missed_rows() const;
  /// Whether the log may grow by `words`; the limit for all walks is some hundred megabytes.
  bool may_log(std::size_t words) {
    return logged_.fetch_add(words, std::memory_order_relaxed) + words <= max_logged;
  }

  bool found_any() const { return found_.load(std::memory_order_relaxed); }
  bool was_cut() const { return cut_.load(std::memory_order_relaxed); }
  bool is_complete() const { return !was_cut() && !is_part_cut_; }
  std::uint64_t nodes() const { return nodes_.load(std::memory_order_relaxed); }
  std::uint64_t work() const { return work_.load(std::memory_order_relaxed); }
  std::optional<Selection> best;  ///< ascending

 private:
  static constexpr std::uint64_t max_misses = 64;
  static constexpr std::uint64_t max_logged = std::uint64_t{1} << 25;

  std::mutex mutex_, reporting_;
  std::vector<bool> is_searched_;
  std::map<LabelId, std::uint64_t> missed_;
  std::uint64_t max_work_, nodes_before_ = 0, misses_before_ = 0;
  bool is_part_cut_ = false;
  std::atomic<std::uint64_t> nodes_{0}, misses_{0}, logged_{0}, work_{0};
  std::atomic<std::int64_t> max_cost_;
  std::atomic<double> margin_{0};  ///< largest minimum margin so far
  Selection widest_;
  std::atomic<bool> found_{false}, cut_{false};
};

}  // namespace shelfbeam::detail
