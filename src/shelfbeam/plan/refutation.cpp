#include "shelfbeam/plan/refutation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "shelfbeam/milp/solver.hpp"

namespace shelfbeam {

namespace {

constexpr auto none = std::numeric_limits<std::uint32_t>::max();
// Leaves stay this far below 1: smaller margins would take too many samples.
constexpr double below = 1 - 1e-4;
constexpr double integral_tolerance = 1e-6;

class Search {
 public:
  Search(const SignalTable& table, const std::vector<LabelId>& labels, const SelectionBudget& limit,
         std::size_t max_leaves, const Deadline& deadline, const RunControl& control)
      : table_(table), max_leaves_(max_leaves), deadline_(deadline), control_(control) {
    tree_.limit = limit;
    tree_.mounts = table.mounts;
    tree_.labels = labels;
    for (const LabelId i : labels) {
      std::vector<double> row(table.columns(), 0.0);
      std::vector<bool> clipped(table.columns(), false);
      for (const SignalEntry& entry : table.row(i)) {
        const double share = entry.signal / table.labels[i].requirement;
        row[entry.transceiver] = std::min(1.0, share);
        clipped[entry.transceiver] = share >= 1;
      }
      const auto k = static_cast<std::uint32_t>(rows_.size());
      rows_.push_back(row);
      tree_.is_clipped.push_back(std::move(clipped));
      add_weights({{k}, {1.0}});  // a label by itself
    }
    is_used_.assign(rows_.size(), false);
    total_.emplace(tree_.limit, tree_.mounts);
  }

  RefutationSearch run(std::span<const Refutation::Leaf> roots) {
    Refutation::Leaf all;
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      (table_.transceivers[j].installed ? all.chosen : all.free).push_back(j);
    RefutationSearch search;
    // Leaves that a test left open are split, unless their margin is wide enough for outliers.
    constexpr double wide_margin = 0.15;
    if (!roots.empty()) max_known_ = below - wide_margin;
    if (roots.empty()) roots = std::span(&all, 1);
    if (std::all_of(roots.begin(), roots.end(),
                    [&](const Refutation::Leaf& root) { return refute(root.chosen, root.free, max_known_); }))
      search.found = used_part(std::move(tree_));
    else
      search.counterexample = std::move(counterexample_);
    return search;
  }

 private:
  std::uint32_t add_weights(Refutation::Weights weights) {
    std::vector<double> value(table_.columns(), 0.0);
    for (std::size_t k = 0; k < weights.rows.size(); ++k)
      for (std::size_t j = 0; j < value.size(); ++j)
        value[j] += weights.weight[k] * rows_[weights.rows[k]][j];
    tree_.weights.push_back(std::move(weights));
    tree_.planned.push_back(std::move(value));
    return static_cast<std::uint32_t>(tree_.planned.size() - 1);
  }

  double left(std::span<const ColumnId> chosen) const {
    double left = tree_.limit.budget;
    for (const ColumnId j : chosen) left -= tree_.limit.price[j];
    return left;
  }

  bool add_leaf(const std::vector<ColumnId>& chosen, std::vector<ColumnId> free, std::uint32_t weights) {
    if (tree_.leaves.size() >= max_leaves_) return false;
    for (const std::uint32_t row : tree_.weights[weights].rows) is_used_[row] = true;
    tree_.leaves.push_back({chosen, std::move(free), weights});
    return true;
  }

  // Every new label takes samples, so weights with new labels need a total that is smaller by this.
  double penalty_of_new_labels(std::uint32_t w) const {
    constexpr double penalty = 0.5;
    const std::vector<std::uint32_t>& rows = tree_.weights[w].rows;
    const bool has_new =
        std::any_of(rows.begin(), rows.end(), [&](std::uint32_t row) { return !is_used_[row]; });
    return has_new ? penalty : 0;
  }

  // The known weights with the smallest total below the maximum, penalty included.
  std::uint32_t closing_weights(const std::vector<ColumnId>& chosen, const std::vector<ColumnId>& free,
                                double max_total) {
    std::uint32_t best = none;
    double smallest = std::numeric_limits<double>::infinity();
    for (std::uint32_t w = 0; w < tree_.planned.size(); ++w) {
      const double total = (*total_)(chosen, free, tree_.planned[w]);
      const double penalised = total + penalty_of_new_labels(w);
      if (total >= max_total || penalised >= smallest) continue;
      smallest = penalised;
      best = w;
    }
    return best;
  }

  // Whether no selection of these columns, the chosen ones included, reaches all labels. The relaxation
  // closes the node if it gives a total below `max_total`.
  bool refute(const std::vector<ColumnId>& chosen, std::vector<ColumnId> free, double max_total = below) {
    if (control_.cancelled() || deadline_.has_passed()) return false;
    const double budget = left(chosen);
    if (budget < 0) return true;  // no selection of the budget
    std::erase_if(free, [&](std::uint32_t j) { return tree_.limit.price[j] > budget; });
    if (const std::uint32_t w = closing_weights(chosen, free, free.empty() ? below : max_known_); w != none)
      return add_leaf(chosen, std::move(free), w);
    if (free.empty()) return fail(chosen);
    if (takes_one(free, budget)) return refute_singles(chosen, free);
    if (const auto weights = relaxation_weights(chosen, free)) {
      const std::uint32_t w = add_weights(*weights);
      if ((*total_)(chosen, free, tree_.planned[w]) < max_total) return add_leaf(chosen, std::move(free), w);
    }
    return branch(chosen, std::move(free), budget);
  }

  // Whether a selection can contain at most one of the columns.
  bool takes_one(const std::vector<ColumnId>& free, double budget) const {
    double first = std::numeric_limits<double>::infinity(), second = first;
    for (const ColumnId j : free) {
      const double price = tree_.limit.price[j];
      second = std::min(second, std::max(first, price));
      first = std::min(first, price);
    }
    return first + second > budget;
  }

  // Each column, and none, leaves the total of some known weights below 1; those of one label suffice.
  bool refute_singles(const std::vector<ColumnId>& chosen, const std::vector<ColumnId>& free) {
    std::vector<double> smallest(free.size(), std::numeric_limits<double>::infinity());
    std::vector<std::uint32_t> best(free.size(), none);
    for (std::uint32_t w = 0; w < tree_.planned.size(); ++w) {
      double total = 0;
      for (const ColumnId j : chosen) total += tree_.planned[w][j];
      if (total >= below) continue;
      const double penalty = penalty_of_new_labels(w);
      for (std::size_t k = 0; k < free.size(); ++k) {
        const double with = total + tree_.planned[w][free[k]];
        if (with >= below || with + penalty >= smallest[k]) continue;
        smallest[k] = with + penalty;
        best[k] = w;
      }
    }
    std::vector<std::vector<ColumnId>> by_weights(tree_.planned.size());
    for (std::size_t k = 0; k < free.size(); ++k) {
      if (best[k] == none) {
        Selection selected = chosen;
        selected.push_back(free[k]);
        return fail(std::move(selected));
      }
      by_weights[best[k]].push_back(free[k]);
    }
    // Cheap columns may let the total of a group take more than one.
    for (std::uint32_t w = 0; w < by_weights.size(); ++w)
      if (!by_weights[w].empty() && !((*total_)(chosen, by_weights[w], tree_.planned[w]) < below))
        return branch(chosen, free, left(chosen));
    for (std::uint32_t w = 0; w < by_weights.size(); ++w)
      if (!by_weights[w].empty() && !add_leaf(chosen, std::move(by_weights[w]), w)) return false;
    return true;  // a selection without any of them is in every one of these leaves
  }

  // The selection reaches all labels.
  bool fail(Selection selected) {
    counterexample_ = std::move(selected);
    std::sort(counterexample_.begin(), counterexample_.end());
    return false;
  }

  // Dual values of max c: c <= sum_{j chosen} x_ij + sum_{j free} x_ij T_j for every row, sum_j p_j T_j
  // within the budget, 0 <= T <= 1.
  std::optional<Refutation::Weights> relaxation_weights(const std::vector<ColumnId>& chosen,
                                                        const std::vector<ColumnId>& free) {
    const auto n = static_cast<std::uint32_t>(free.size());
    std::vector<milp::Column> columns(n, {0, 0, 1, false, {}});
    columns.push_back({-1, 0, milp::infinity, false, {}});
    auto lp = milp::backends().front().lp(columns);
    std::vector<milp::Row> rows(1);
    rows[0].upper = left(chosen);
    for (std::uint32_t k = 0; k < n; ++k) rows[0].entries.push_back({k, tree_.limit.price[free[k]]});
    for (const std::vector<double>& values : rows_) {
      milp::Row row{0, milp::infinity, {{n, -1.0}}, {}};
      for (const ColumnId j : chosen) row.lower -= values[j];
      for (std::uint32_t k = 0; k < n; ++k)
        if (values[free[k]] > 0) row.entries.push_back({k, values[free[k]]});
      rows.push_back(std::move(row));
    }
    lp->add_rows(rows);
    const milp::LpResult solved = lp->solve(deadline_.seconds_left(), control_);
    if (solved.termination != milp::Termination::optimal) return std::nullopt;
    Refutation::Weights weights;
    double sum = 0;
    constexpr double negligible = 1e-4;
    for (std::uint32_t k = 0; k < rows_.size(); ++k)
      if (const double y = solved.y[k + 1]; y > negligible) {
        weights.rows.push_back(k);
        weights.weight.push_back(y);
        sum += y;
      }
    if (weights.rows.empty()) return std::nullopt;
    for (double& weight : weights.weight) weight /= sum;
    return weights;
  }

  // A selection that reaches a label has a column that makes up for at least an even share of the label's
  // lack. Branches on these columns for the label that has the fewest, the strongest first.
  bool branch(const std::vector<ColumnId>& chosen, std::vector<ColumnId> free, double budget) {
    std::vector<ColumnId> supporters;
    bool is_first = true;
    for (const std::vector<double>& row : rows_) {
      double lack = 1;
      for (const ColumnId j : chosen) lack -= row[j];
      if (lack <= 0) continue;
      std::vector<ColumnId> of_row;
      for (const ColumnId j : free)
        if (row[j] >= below * lack * tree_.limit.price[j] / budget - (1 - below)) of_row.push_back(j);
      if (!is_first && of_row.size() >= supporters.size()) continue;
      is_first = false;
      std::sort(of_row.begin(), of_row.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(-row[a], a) < std::pair(-row[b], b);
      });
      supporters = std::move(of_row);
    }
    if (is_first) return fail(chosen);
    for (const ColumnId j : supporters) {
      std::erase(free, j);
      std::vector<ColumnId> with = chosen;
      with.push_back(j);
      if (!refute(with, allowed_with(j, free))) return false;
      if (const std::uint32_t w = closing_weights(chosen, free, max_known_); w != none)
        return add_leaf(chosen, std::move(free), w);
    }
    // The weights of the label close the rest, up to rounding.
    const std::uint32_t w = closing_weights(chosen, free, below);
    return w != none && add_leaf(chosen, std::move(free), w);
  }

  // The columns that a selection with this one may contain.
  std::vector<ColumnId> allowed_with(ColumnId chosen, std::vector<ColumnId> columns) const {
    const auto exclude = [&](ColumnId j) { std::erase(columns, j); };
    for (const auto& mount : table_.mounts)
      if (std::binary_search(mount.begin(), mount.end(), chosen))
        std::for_each(mount.begin(), mount.end(), exclude);
    for (const auto& [a, b] : table_.conflicts)
      if (a == chosen || b == chosen) exclude(a == chosen ? b : a);
    return columns;
  }

  const SignalTable& table_;
  std::size_t max_leaves_;
  const Deadline& deadline_;
  const RunControl& control_;
  Refutation tree_;
  std::vector<std::vector<double>> rows_;  ///< shares of requirements, at most 1, by label and column
  std::vector<bool> is_used_;              ///< by row: a leaf has it
  double max_known_ = below;               ///< totals by which known weights close a node
  std::optional<LeafTotal> total_;
  Selection counterexample_;
};

}  // namespace

Refutation used_part(Refutation tree) {
  std::vector<std::uint32_t> weights_at(tree.weights.size(), none), row_at(tree.labels.size(), none);
  Refutation kept;
  kept.limit = std::move(tree.limit);
  kept.mounts = std::move(tree.mounts);
  for (Refutation::Leaf& leaf : tree.leaves) {
    std::uint32_t& at = weights_at[leaf.weights];
    if (at == none) {
      at = static_cast<std::uint32_t>(kept.weights.size());
      kept.weights.push_back(std::move(tree.weights[leaf.weights]));
      kept.planned.push_back(std::move(tree.planned[leaf.weights]));
      for (const std::uint32_t row : kept.weights.back().rows) row_at[row] = 0;
    }
    leaf.weights = at;
  }
  kept.leaves = std::move(tree.leaves);
  for (std::uint32_t k = 0; k < row_at.size(); ++k) {
    if (row_at[k] == none) continue;
    row_at[k] = static_cast<std::uint32_t>(kept.labels.size());
    kept.labels.push_back(tree.labels[k]);
    kept.is_clipped.push_back(std::move(tree.is_clipped[k]));
  }
  for (Refutation::Weights& weights : kept.weights)
    for (std::uint32_t& row : weights.rows) row = row_at[row];
  return kept;
}

LeafTotal::LeafTotal(const SelectionBudget& limit, const std::vector<std::vector<ColumnId>>& mounts)
    : limit_(limit), mount_of_(limit.price.size(), none), of_mount_(mounts.size()) {
  for (std::uint32_t m = 0; m < mounts.size(); ++m)
    for (const ColumnId j : mounts[m]) mount_of_[j] = m;
  is_count_ = mounts.empty() &&
              std::all_of(limit.price.begin(), limit.price.end(), [](double price) { return price == 1; });
}

// The largest values, kept in ascending order.
double LeafTotal::top(double total, double left, std::span<const ColumnId> free,
                      std::span<const double> value) {
  const auto units = static_cast<std::size_t>(std::max(0.0, left));
  if (units == 0) return total;
  top_.assign(units, 0.0);
  for (const ColumnId j : free) {
    if (value[j] <= top_[0]) continue;
    std::size_t k = 0;
    for (; k + 1 < units && top_[k + 1] < value[j]; ++k) top_[k] = top_[k + 1];
    top_[k] = value[j];
  }
  return std::accumulate(top_.begin(), top_.end(), total);
}

double LeafTotal::operator()(std::span<const ColumnId> chosen, std::span<const ColumnId> free,
                             std::span<const double> value) {
  double total = 0, left = limit_.budget;
  for (const ColumnId j : chosen) {
    total += value[j];
    left -= limit_.price[j];
  }
  if (is_count_) return top(total, left, free, value);
  items_.clear();
  for (Item& item : of_mount_) item = {0, std::numeric_limits<double>::infinity()};
  for (const ColumnId j : free) {
    if (!(value[j] > 0) || limit_.price[j] > left) continue;
    if (mount_of_[j] == none) {
      items_.push_back({value[j], limit_.price[j]});
    } else {
      Item& item = of_mount_[mount_of_[j]];
      item = {std::max(item.value, value[j]), std::min(item.price, limit_.price[j])};
    }
  }
  for (const Item& item : of_mount_)
    if (item.value > 0) items_.push_back(item);
  const double of_count = total + largest_items(left);
  const auto is_better = [](const Item& a, const Item& b) { return a.value * b.price < b.value * a.price; };
  std::make_heap(items_.begin(), items_.end(), is_better);
  while (left > 0 && !items_.empty()) {
    std::pop_heap(items_.begin(), items_.end(), is_better);
    const Item item = items_.back();
    items_.pop_back();
    total += item.value * std::min(1.0, left / item.price);
    left -= item.price;
  }
  return std::min(total, of_count);
}

// The largest values, as many as the cheapest items would fit.
double LeafTotal::largest_items(double left) {
  double min_price = std::numeric_limits<double>::infinity(), sum = 0;
  for (const Item& item : items_) min_price = std::min(min_price, item.price);
  const double units = std::floor(left / min_price * (1 + std::numeric_limits<double>::epsilon()));
  const auto count = static_cast<std::ptrdiff_t>(std::min(units, static_cast<double>(items_.size())));
  std::nth_element(items_.begin(), items_.begin() + count, items_.end(),
                   [](const Item& a, const Item& b) { return a.value > b.value; });
  for (auto item = items_.begin(); item != items_.begin() + count; ++item) sum += item->value;
  return sum;
}

RefutationSearch find_refutation(const SignalTable& table, const std::vector<LabelId>& labels,
                                 const SelectionBudget& limit, std::span<const Refutation::Leaf> roots,
                                 std::size_t max_leaves, const Deadline& deadline,
                                 const RunControl& control) {
  return Search(table, labels, limit, max_leaves, deadline, control).run(roots);
}

}  // namespace shelfbeam
