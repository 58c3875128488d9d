#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/placement/tree/tree_search.hpp"

namespace shelfbeam::detail {

/// What the walks of one tree search share.
class TreeRun {
 public:
  TreeRun(const SearchProblem& problem, const SearchMatrix& all, const SearchMatrix& matrix,
          const TreeGoal& goal, const TreeSearch::Limits& limits, const RunControl& control);

  /// A part of it that begins with what is known now, keeps to itself what it finds, and has one of so many
  /// shares of the work that is left.
  TreeRun(const TreeRun& whole, std::uint64_t shares);
  /// Takes over what a part has found.
  void join(const TreeRun& part);

  /// Counts a node; true when the search ends here, found or not.
  bool ends();
  /// Counts places of the matrix that are looked at.
  void count_work(std::uint64_t places) { work_.fetch_add(places, std::memory_order_relaxed); }
  /// The margin that a selection must have, as float arithmetic may test it.
  float target() const;
  double exact_target() const;
  std::int64_t most_cost() const { return most_cost_.load(std::memory_order_relaxed); }

  /// A selection that meets the search's rows. Returns how it does on all of them; kept if it is the best.
  Margin offer(std::span<const std::uint32_t> selected, std::vector<float>& memory);
  /// A row outside the search's that a selection left unmet.
  void miss(std::uint32_t row);
  /// Rows are missed so often that they had better be searched with.
  bool misses_rows() const { return misses_.load(std::memory_order_relaxed) > most_misses; }
  std::vector<std::uint32_t> missed_rows() const;
  /// Whether the log may grow by so many words; all walks together have some hundred megabytes.
  bool may_log(std::size_t words) {
    return logged_.fetch_add(words, std::memory_order_relaxed) + words <= most_logged;
  }

  const SearchProblem& problem;
  const SearchMatrix& all;
  const SearchMatrix& matrix;
  const TreeGoal& goal;
  const TreeSearch::Limits& limits;
  Receiving rule;

  bool found_any() const { return found_.load(std::memory_order_relaxed); }
  bool was_cut() const { return cut_.load(std::memory_order_relaxed); }
  bool is_complete() const { return !was_cut() && !is_part_cut_; }
  std::uint64_t nodes() const { return nodes_.load(std::memory_order_relaxed); }
  std::uint64_t work() const { return work_.load(std::memory_order_relaxed); }
  std::optional<std::vector<std::uint32_t>> best;  ///< ascending

 private:
  static constexpr std::uint64_t most_misses = 64;
  static constexpr std::uint64_t most_logged = std::uint64_t{1} << 25;

  const RunControl& control_;
  std::mutex mutex_, reporting_;
  std::vector<bool> is_searched_;
  std::map<std::uint32_t, std::uint64_t> missed_;
  std::uint64_t most_work_, nodes_before_ = 0, misses_before_ = 0;
  bool is_part_cut_ = false;
  std::atomic<std::uint64_t> nodes_{0}, misses_{0}, logged_{0}, work_{0};
  std::atomic<std::int64_t> most_cost_;
  std::atomic<double> margin_{0};  ///< of the widest so far
  std::vector<std::uint32_t> widest_;
  std::atomic<bool> found_{false}, cut_{false};
};

}  // namespace shelfbeam::detail
