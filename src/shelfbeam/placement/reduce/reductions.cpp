#include "shelfbeam/placement/reduce/reductions.hpp"

#include <algorithm>
#include <string_view>
#include <unordered_set>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"
#include "shelfbeam/placement/reduce/bit_set.hpp"

namespace shelfbeam::detail {

namespace {

constexpr std::uint32_t no_column = ~std::uint32_t{0};

class CoverReducer {
 public:
  CoverReducer(const Instance& instance, std::span<const double> cost, const std::vector<bool>& pinned,
               const std::function<bool()>& stop, std::span<const ColumnId> omitted)
      : table_(instance.table),
        mounts_(instance.mounts),
        stop_(stop),
        cost_(cost),
        pinned_(pinned.empty() ? std::vector<bool>(instance.columns(), false) : pinned),
        rows_(instance.rows(), BitSet(instance.columns())),
        open_(instance.columns(), true),
        forced_(instance.columns(), false),
        unmet_(instance.rows(), true) {
    const CoverRows cover(instance);
    for (std::uint32_t i = 0; i < instance.rows(); ++i)
      cover.for_entries(i, [&](std::uint32_t j, double) { rows_[i].insert(j); });
    for (const ColumnId j : omitted) open_[j] = false;
  }

  Reduction run() {
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (table_.transceivers[j].installed) force(j);
    drop_met_labels();
    drop_dominated_labels();
    while (!infeasible_ && !stops() && (force_columns() || drop_dominated_columns())) drop_dominated_labels();
    Reduction result{infeasible_, numbers_where<ColumnId>(forced_), {}};
    if (!infeasible_) result.parts = parts();
    return result;
  }

 private:
  bool stops() const { return stop_ && stop_(); }

  void force(ColumnId column) {
    for (const ColumnId option : mounts_.options(column)) open_[option] = false;
    open_[column] = false;
    forced_[column] = true;
  }

  std::vector<ColumnId> open_columns(LabelId label) const {
    std::vector<ColumnId> columns;
    rows_[label].for_each([&](std::uint32_t j) {
      if (open_[j]) columns.push_back(j);
    });
    return columns;
  }

  void drop_met_labels() {
    for (std::uint32_t i = 0; i < unmet_.size(); ++i)
      rows_[i].for_each([&](std::uint32_t j) {
        if (forced_[j]) unmet_[i] = false;
      });
  }

  // A forced option closes others, which may leave a label with one open column or none.
  bool force_columns() {
    bool forced_any = false;
    for (bool changed = true; changed && !infeasible_;) {
      changed = false;
      for (std::uint32_t i = 0; i < unmet_.size() && !infeasible_; ++i) {
        if (!unmet_[i]) continue;
        const auto columns = open_columns(i);
        infeasible_ = columns.empty();
        if (columns.size() != 1) continue;
        force(columns.front());
        drop_met_labels();
        changed = forced_any = true;
      }
    }
    return forced_any;
  }

  // Rows in order of size: only a smaller row can be contained in another. Each row is filed under its rarest
  // column, so a row is compared only with rows filed under its own columns.
  void drop_dominated_labels() {
    const std::vector<LabelId> labels = numbers_where<LabelId>(unmet_);
    std::vector<BitSet> rows(labels.size(), BitSet(table_.columns()));
    std::vector<std::uint32_t> size(labels.size(), 0), reached(table_.columns(), 0);
    for (std::size_t k = 0; k < labels.size(); ++k)
      for (const ColumnId j : open_columns(labels[k])) rows[k].insert(j), ++size[k], ++reached[j];

    std::vector<std::uint32_t> order;
    std::unordered_set<std::string_view> seen;
    for (std::uint32_t k = 0; k < labels.size(); ++k) {
      if (seen.insert(rows[k].bytes()).second)
        order.push_back(k);
      else
        unmet_[labels[k]] = false;
    }
    std::ranges::stable_sort(order, {}, [&](std::uint32_t k) { return size[k]; });
    std::vector<std::vector<std::uint32_t>> kept(table_.columns());
    for (const std::uint32_t k : order) {
      if (k % 64 == 0 && stops()) return;
      std::uint32_t rarest = no_column;
      bool dominated = false;
      rows[k].for_each([&](std::uint32_t j) {
        if (rarest == no_column || reached[j] < reached[rarest]) rarest = j;
        dominated = dominated || std::any_of(kept[j].begin(), kept[j].end(), [&](std::uint32_t other) {
                      return rows[other].is_subset(rows[k]);
                    });
      });
      if (dominated)
        unmet_[labels[k]] = false;
      else if (rarest != no_column)
        kept[rarest].push_back(k);
    }
  }

  bool may_replace(ColumnId in, ColumnId out) const {
    const bool has_own_mount = mounts_.options(in).empty();
    return !pinned_[in] && (has_own_mount || mounts_.first_option(in) == mounts_.first_option(out)) &&
           cost_[in] <= cost_[out];
  }

  bool drop_dominated_columns() {
    const std::vector<LabelId> labels = numbers_where<LabelId>(unmet_);
    std::vector<std::vector<ColumnId>> columns(labels.size());
    std::vector<BitSet> reach(table_.columns(), BitSet(labels.size()));
    std::vector<std::uint32_t> size(table_.columns(), 0);
    for (std::uint32_t k = 0; k < labels.size(); ++k) {
      columns[k] = open_columns(labels[k]);
      for (const ColumnId j : columns[k]) reach[j].insert(k), ++size[j];
    }
    bool dropped = false;
    // Columns are closed one at a time, compared with open columns, so one of equal columns stays.
    for (auto j = static_cast<std::uint32_t>(table_.columns()); j-- > 0;) {
      if (!open_[j] || pinned_[j]) continue;
      if (j % 64 == 0 && stops()) break;
      const std::vector<ColumnId>* fewest = nullptr;
      reach[j].for_each([&](std::uint32_t k) {
        if (fewest == nullptr || columns[k].size() < fewest->size()) fewest = &columns[k];
      });
      const bool is_dominated =
          fewest == nullptr || std::any_of(fewest->begin(), fewest->end(), [&](std::uint32_t other) {
            return size[other] >= size[j] && other != j && open_[other] && may_replace(other, j) &&
                   reach[j].is_subset(reach[other]);
          });
      if (!is_dominated) continue;
      open_[j] = false;
      dropped = true;
    }
    return dropped;
  }

  std::vector<CoverPart> parts() const {
    std::vector<std::uint32_t> parent = all_numbers(table_.columns());
    const auto root = [&](std::uint32_t j) {
      while (parent[j] != j) j = parent[j] = parent[parent[j]];
      return j;
    };
    const auto join = [&](const std::vector<ColumnId>& columns) {
      for (const ColumnId j : columns) parent[root(j)] = root(columns.front());
    };
    const std::vector<LabelId> labels = numbers_where<LabelId>(unmet_);
    for (const LabelId i : labels) join(open_columns(i));
    join(numbers_where<ColumnId>(open_.size(), [&](ColumnId j) { return open_[j] && pinned_[j]; }));
    for (std::vector<ColumnId> mount : table_.mounts) {
      std::erase_if(mount, [&](std::uint32_t j) { return !open_[j]; });
      join(mount);
    }

    std::vector<CoverPart> result;
    std::vector<std::uint32_t> part(table_.columns(), no_column);
    const auto part_of = [&](ColumnId column) -> CoverPart& {
      std::uint32_t& k = part[root(column)];
      if (k == no_column) {
        k = static_cast<std::uint32_t>(result.size());
        result.emplace_back();
      }
      return result[k];
    };
    for (const LabelId i : labels) part_of(open_columns(i).front()).labels.push_back(i);
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (open_[j]) part_of(j).columns.push_back(j);
    return result;
  }

  const SignalTable& table_;
  const Mounts& mounts_;
  const std::function<bool()>& stop_;
  std::span<const double> cost_;
  std::vector<bool> pinned_;
  std::vector<BitSet> rows_;  ///< per label: the columns that reach it, open or not
  std::vector<bool> open_;    ///< per column: neither forced nor closed
  std::vector<bool> forced_;
  std::vector<bool> unmet_;  ///< per label: neither reached nor dropped
  bool infeasible_ = false;
};

}  // namespace

Reduction reduce_cover(const Instance& instance, std::span<const double> cost,
                       const std::vector<bool>& pinned, const std::function<bool()>& stop,
                       std::span<const ColumnId> omitted) {
  return CoverReducer(instance, cost, pinned, stop, omitted).run();
}

std::vector<bool> blocked_columns(const Instance& instance, const Reduction& reduction) {
  std::vector<bool> blocked(instance.columns(), false);
  for (const ColumnId j : reduction.forced)
    for (const ColumnId other : instance.excludes[j]) blocked[other] = true;
  return blocked;
}

}  // namespace shelfbeam::detail
