#include "shelfbeam/placement/windows/cover_tree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>

#include "shelfbeam/math/cpu_vectors.hpp"
#include "shelfbeam/placement/reduce/bit_set.hpp"

namespace shelfbeam::detail {

namespace {

/// Counts the members that some sets share with another one.
SHELFBEAM_FOR_EACH_CPU
void count_common(std::span<const std::uint32_t> some, std::span<const BitSet> sets, const BitSet& other,
                  std::span<std::uint32_t> count) {
  const std::span<const std::uint64_t> others = other.words();
  for (const std::uint32_t k : some) {
    const std::uint64_t* const words = sets[k].words().data();
    int sum = 0;
    for (std::size_t w = 0; w < others.size(); ++w) sum += std::popcount(words[w] & others[w]);
    count[k] = static_cast<std::uint32_t>(sum);
  }
}

class CoverTree {
 public:
  CoverTree(const SmallCover& cover, double known, const CoverTreeLimits& limits)
      : cover_(cover), limits_(limits), best_(known), rounding_(1e-9 * known), rows_of_(cover.cost.size()) {
    for (std::size_t i = 0; i < cover.rows.size(); ++i) {
      row_bits_.emplace_back(cover.cost.size());
      for (const std::uint32_t j : cover.rows[i]) {
        row_bits_[i].insert(j);
        rows_of_[j].push_back(static_cast<std::uint32_t>(i));
      }
    }
    count_.resize(cover.rows.size());
    for (const auto& row : cover.rows) tight_.push_back(row.empty() ? 0 : row.front());
    for (const auto& rows : rows_of_) {
      column_bits_.emplace_back(cover.rows.size());
      for (const std::uint32_t i : rows) column_bits_.back().insert(i);
    }
  }

  FoundCovers cheapest(std::span<const double> y) {
    run(y);
    found_.bound = std::max(0.0, std::min(best_, open_bound_) - 2 * rounding_);
    return std::move(found_);
  }

  FoundCovers columns(std::span<const double> y) {
    is_found_ = BitSet(cover_.cost.size());
    best_ += 2 * rounding_;
    finds_columns_ = true;
    run(y);
    for (std::size_t j = 0; j < cover_.cost.size(); ++j)
      found_.contains.push_back(!found_.complete || is_found_.contains(j));
    return std::move(found_);
  }

 private:
  struct Node {
    std::vector<double> y, slack;
    BitSet rows, columns;  ///< open
    double bound = 0;
  };

  void run(std::span<const double> y) {
    nodes_.resize(cover_.rows.size() + 1);
    nodes_[0] = root(y);
    visit(0);
  }

  Node root(std::span<const double> y) const {
    Node node;
    node.y.assign(cover_.rows.size(), 0.0);
    node.slack = cover_.cost;
    node.rows = BitSet(cover_.rows.size(), true);
    node.columns = BitSet(cover_.cost.size(), true);
    for (std::size_t i = 0; i < y.size(); ++i)
      if (y[i] > 0 && std::isfinite(y[i])) raise(node, i, y[i]);
    // The LP's tolerances leave negative slacks.
    for (std::size_t j = 0; j < node.slack.size(); ++j)
      for (const std::uint32_t i : rows_of_[j])
        if (node.slack[j] < 0) raise(node, i, -std::min(node.y[i], -node.slack[j]));
    return node;
  }

  void raise(Node& node, std::size_t i, double by) const {
    node.y[i] += by;
    node.bound += by;
    for (const std::uint32_t j : cover_.rows[i]) node.slack[j] -= by;
  }

  bool is_closed(const Node& node) const { return node.bound >= best_ - rounding_; }

  bool is_over() {
    constexpr std::uint64_t often = 256;
    found_.complete = found_.complete && found_.nodes < limits_.effort.steps &&
                      (found_.nodes % often != 0 || !limits_.is_over());
    return !found_.complete;
  }

  void forbid_expensive_columns(Node& node) const {
    node.columns.for_each([&](std::uint32_t j) {
      if (node.bound + node.slack[j] >= best_ - rounding_) node.columns.erase(j);
    });
  }

  // Of a row's open columns. The column of the last time often has none left.
  double smallest_slack(const Node& node, std::uint32_t i) {
    std::uint32_t& tight = tight_[i];
    if (node.columns.contains(tight) && node.slack[tight] <= 0) return 0;
    double smallest = std::numeric_limits<double>::infinity();
    row_bits_[i].for_common(node.columns, [&](std::uint32_t j) {
      if (node.slack[j] < smallest) tight = j;
      smallest = std::min(smallest, node.slack[j]);
      return smallest > 0;
    });
    return smallest;
  }

  void count_columns(const Node& node) { count_common(rows_, row_bits_, node.columns, count_); }

  // The open rows, those with the fewest columns first.
  void sort_rows(const Node& node) {
    rows_.clear();
    node.rows.for_each([&](std::uint32_t i) { rows_.push_back(i); });
    count_columns(node);
    begin_.assign(cover_.cost.size() + 2, 0);
    for (const std::uint32_t i : rows_) ++begin_[count_[i] + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    order_.resize(rows_.size());
    for (const std::uint32_t i : rows_) order_[begin_[count_[i]]++] = i;
  }

  // Dual ascent in this order; false if the node is closed.
  bool ascend(Node& node) {
    sort_rows(node);
    for (const std::uint32_t i : order_) {
      if (count_[i] == 0) return false;
      const double by = smallest_slack(node, i);
      if (by > 0) raise(node, i, by);
      if (is_closed(node)) return false;
    }
    return true;
  }

  // The open row with the fewest columns.
  std::uint32_t branching_row(const Node& node) {
    count_columns(node);
    return *std::ranges::min_element(order_, {}, [&](std::uint32_t i) { return count_[i]; });
  }

  // Without open rows, the slack of a column is its cost.
  void accept(Node& node) {
    if (!finds_columns_) {
      best_ = node.bound;
      found_.selected = chosen_;
      return;
    }
    forbid_expensive_columns(node);
    for (const std::uint32_t j : chosen_) is_found_.insert(j);
    node.columns.for_each([&](std::uint32_t j) { is_found_.insert(j); });
  }

  bool has_no_new_column(const Node& node) const {
    return node.columns.is_subset(is_found_) &&
           std::ranges::all_of(chosen_, [&](std::uint32_t j) { return is_found_.contains(j); });
  }

  // nodes_[depth] explored; its subtree stays open if the search ends.
  void visit(std::size_t depth) {
    Node& node = nodes_[depth];
    if (is_closed(node)) return;
    if (is_over()) {
      open_bound_ = std::min(open_bound_, node.bound);
      return;
    }
    ++found_.nodes;
    if (node.rows.empty()) return accept(node);
    forbid_expensive_columns(node);
    if (!ascend(node)) return;
    forbid_expensive_columns(node);
    if (finds_columns_ && has_no_new_column(node)) return;
    const std::uint32_t row = branching_row(node);
    std::vector<std::pair<double, std::uint32_t>> children;
    row_bits_[row].for_common(node.columns,
                              [&](std::uint32_t j) { children.emplace_back(node.slack[j], j); });
    std::sort(children.begin(), children.end());
    for (const auto& [slack, j] : children) {
      if (node.bound + slack >= best_ - rounding_) return;
      node.columns.erase(j);
      choose(j, node, nodes_[depth + 1]);
      chosen_.push_back(j);
      visit(depth + 1);
      chosen_.pop_back();
    }
  }

  // Rows that j reaches are no longer open, and their multipliers return to the other columns.
  void choose(std::uint32_t j, const Node& node, Node& child) const {
    child = node;
    child.bound += node.slack[j];
    column_bits_[j].for_common(node.rows, [&](std::uint32_t i) {
      child.rows.erase(i);
      if (child.y[i] > 0)
        for (const std::uint32_t k : cover_.rows[i]) child.slack[k] += child.y[i];
      child.y[i] = 0;
    });
  }

  const SmallCover& cover_;
  const CoverTreeLimits& limits_;
  double best_;
  double rounding_;  ///< exceeds the rounding errors of all sums, which have less than a million terms
  std::vector<std::vector<std::uint32_t>> rows_of_;
  std::vector<BitSet> row_bits_, column_bits_;
  std::vector<Node> nodes_;  ///< the path from the root, by depth
  std::vector<std::uint32_t> chosen_;
  std::vector<std::uint32_t> rows_, order_;  ///< the open rows of the present node, ascending and sorted
  std::vector<std::uint32_t> count_;         ///< per row, of its open columns
  std::vector<std::uint32_t> begin_;  ///< per number of columns, the place of its first row in `order_`
  std::vector<std::uint32_t> tight_;  ///< per row, the column of its last smallest slack
  double open_bound_ = std::numeric_limits<double>::infinity();  ///< of the subtrees left open
  bool finds_columns_ = false;
  BitSet is_found_;  ///< columns of covers
  FoundCovers found_;
};

}  // namespace

FoundCovers cheapest_cover(const SmallCover& cover, std::span<const double> y, double known,
                           const CoverTreeLimits& limits) {
  return CoverTree(cover, known, limits).cheapest(y);
}

FoundCovers columns_of_covers(const SmallCover& cover, std::span<const double> y, double known,
                              const CoverTreeLimits& limits) {
  return CoverTree(cover, known, limits).columns(y);
}

}  // namespace shelfbeam::detail
