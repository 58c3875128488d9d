#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam {

/// The selections whose prices sum to at most `budget`. With a price of 1 per unit, the budget is a count.
struct SelectionBudget {
  std::vector<double> price;  ///< by column, positive
  double budget = 0;
};

/// A tree that refutes all selections S of a budget where signals add up. Each of these
/// selections is in at least one leaf. Each leaf has weights w_i >= 0 of labels, with sum 1, for which no
/// selection of the leaf supplies
///
///   sum_{j in S} x_j >= 1,   x_j = sum_i w_i x_ij,   x_ij = 1 if clipped, else M_ij / (gamma_i tau_i).
///
/// A selection that reaches all labels does: its signals add up to the requirement of every label, and a
/// clipped entry alone makes up for all others. Any set of clipped entries is valid. All parts of a
/// refutation are fixed before the samples that test it (docs/methods/certified_plan.md).
struct Refutation {
  struct Weights {
    std::vector<std::uint32_t> rows;  ///< positions in `labels`
    std::vector<double> weight;
  };
  struct Leaf {
    std::vector<ColumnId> chosen;  ///< in every selection of the leaf, installed units included
    std::vector<ColumnId> free;    ///< the other columns that a selection may contain
    std::uint32_t weights = 0;     ///< position in `weights`
  };

  SelectionBudget limit;
  std::vector<std::vector<ColumnId>> mounts;  ///< at most one column each, as in SignalTable
  std::vector<LabelId> labels;                ///< ascending
  std::vector<std::vector<bool>> is_clipped;  ///< by row and column
  std::vector<Weights> weights;
  std::vector<std::vector<double>> planned;  ///< x_j of the table that was searched, by weights and column
  std::vector<Leaf> leaves;
};

/// The refutation without weights that no leaf has, and without labels that have no weight.
Refutation used_part(Refutation tree);

/// The largest sum of `value` over a selection of a leaf, or a little more: its chosen columns, and free ones
/// in descending order of value per price until the budget ends, the last one in part; no more than the
/// largest values of as many columns as the budget allows. Options of a mounting point count as one column.
class LeafTotal {
 public:
  LeafTotal(const SelectionBudget& limit, const std::vector<std::vector<ColumnId>>& mounts);
  double operator()(std::span<const ColumnId> chosen, std::span<const ColumnId> free,
                    std::span<const double> value);

 private:
  struct Item {
    double value, price;
  };
  double largest_items(double left);
  double top(double total, double left, std::span<const ColumnId> free, std::span<const double> value);

  const SelectionBudget& limit_;
  bool is_count_ = false;  ///< all prices are 1, and no mounting point has options
  std::vector<double> top_;
  std::vector<std::uint32_t> mount_of_;  ///< by column: its mounting point with options, or none
  std::vector<Item> items_, of_mount_;
};

/// The result of a search for a refutation.
struct RefutationSearch {
  std::optional<Refutation> found;
  /// Otherwise, a selection that reaches all examined labels, if the search met one.
  Selection counterexample;
};

/// Searches for a refutation of the selections in `roots` (or of all selections, if there are none) by some
/// labels of a table, whose signals should be raised by some standard errors. Branches on the columns that
/// can make up for a label's lack; linear programs give weights. Ends without a refutation at `max_leaves`,
/// at the deadline, or when cancelled.
RefutationSearch find_refutation(const SignalTable& table, const std::vector<LabelId>& labels,
                                 const SelectionBudget& limit, std::span<const Refutation::Leaf> roots,
                                 std::size_t max_leaves, const Deadline& deadline, const RunControl& control);

}  // namespace shelfbeam
