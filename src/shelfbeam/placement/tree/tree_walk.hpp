#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
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

/// The part of a search's matrix that matters below a node: rows that lack something, columns that are
/// allowed.
struct TreeWindow {
  std::vector<std::uint32_t> rows;  ///< of the search's matrix
  std::vector<std::uint32_t> slot;  ///< by column
  std::size_t padded = 0;
  std::vector<float> values;

  const float* column(std::uint32_t j) const { return values.data() + slot[j] * padded; }
};

/// One depth-first walk below a node.
class TreeWalk {
 public:
  /// `number` tells its weights in the proof from those of other walks; 0 for the root.
  TreeWalk(TreeRun& run, std::span<const float> weights, std::uint32_t number);

  /// From the root, its children on all threads.
  void from_root();

  /// Steps and weights of this walk and those below it.
  void move_log_to(Proof& proof);
  /// With which the root was left, one a row of the search's matrix.
  const std::vector<float>& weights() const { return frames_.front().weight; }

 private:
  struct Frame {
    std::shared_ptr<const TreeWindow> window, below;  ///< of this node and of its children,
    std::vector<std::uint32_t>
        kept;  ///< whose rows are these of the node's window; unused where both are one
    std::vector<float> value, best, lacking, weight, share, shift, counted, supporters, gain;
    std::vector<std::uint32_t> allowed, order;
    std::uint32_t weights_id = unlogged;
    bool by_cost = false;  ///< shares are of the cost that is left, not of the units
  };
  struct Bound {
    double need = 0, most = 0, without_one = 0;
    float price = 0;
  };
  static constexpr std::uint32_t unlogged = ~std::uint32_t{0};

  void visit(std::size_t depth);
  void visit_children(std::size_t depth);
  void children_in_parallel();
  void add_child(TreeRun& run, std::uint32_t column);
  bool enter(std::size_t depth);
  void complete(std::size_t depth);
  void take_last(std::size_t depth);
  bool bound(std::size_t depth);
  void score(Frame& frame, std::size_t units);
  SearchKernels::Rows rows_of(const Frame& frame) const;
  Bound surrogate(const Frame& frame, std::size_t units);
  void sharpen(Frame& frame, std::size_t units);
  std::size_t forbid_useless(Frame& frame, const Bound& bound);
  void choose_branch(std::size_t depth);
  void branch_on(std::size_t depth, std::uint32_t row, double least);
  void narrow(Frame& frame);
  void make_child(const Frame& parent, std::uint32_t column, Frame& child);
  void forbid(Frame& frame, std::uint32_t column);
  static void look_through(Frame& frame, std::shared_ptr<const TreeWindow> window);

  std::size_t units_left(std::size_t depth) const { return most_units_ - depth; }
  std::int64_t cost_left() const { return run_.most_cost() - spent_; }
  void log(std::uint32_t word) {
    if (logs_) steps_.push_back(word);
  }
  void log_weights(Frame& frame, Proof::Tag tag, float price);

  TreeRun& run_;
  bool logs_;
  std::size_t most_units_;  ///< beside those that every selection holds
  std::vector<std::uint32_t> chosen_;
  std::int64_t spent_ = 0;
  std::vector<Frame> frames_;
  std::vector<float> memory_, load_;
  std::vector<double> top_;
  std::uint32_t number_;
  std::vector<std::uint32_t> steps_;
  std::vector<std::vector<float>> weights_;
  std::vector<std::unique_ptr<TreeWalk>> children_;  ///< of the root, with the columns that they take
  std::vector<std::uint32_t> columns_of_children_;
};

}  // namespace shelfbeam::detail
