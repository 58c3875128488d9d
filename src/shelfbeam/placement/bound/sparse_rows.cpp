#include "shelfbeam/placement/bound/sparse_rows.hpp"

#include <algorithm>

#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

SparseRows::SparseRows(const Instance& instance, std::span<const double> cost, const SelectionSet& selections,
                       std::span<const BoundRow> rows) {
  const std::vector<ColumnState> states = states_of(instance, selections);
  std::vector<std::uint32_t> place(instance.columns(), 0);  // of open columns
  for (std::uint32_t j = 0; j < instance.columns(); ++j) {
    if (states[j] == ColumnState::chosen) {
      chosen_.push_back(j);
      chosen_cost_ += cost[j];
    }
    if (states[j] != ColumnState::open) continue;
    place[j] = static_cast<std::uint32_t>(column_.size());
    column_.push_back(j);
    cost_.push_back(cost[j]);
  }
  min_count_ = selections.min_count - std::min(selections.min_count, chosen_.size());
  max_count_ = selections.max_count - std::min(selections.max_count, chosen_.size());
  group_.assign(column_.size(), no_group);
  for (const auto& mount : instance.table.mounts) {
    bool is_open = false;
    for (const ColumnId j : mount) {
      if (states[j] != ColumnState::open) continue;
      group_[place[j]] = static_cast<std::uint32_t>(groups_);
      is_open = true;
    }
    groups_ += is_open ? 1 : 0;
  }

  const CoverRows cover(instance, selections.max_count);
  column_begin_.assign(column_.size() + 1, 0);
  for (const BoundRow& row : rows) {
    double met = 0;
    const double rhs = cover.read(row, [&](std::uint32_t j, double a) {
      if (states[j] == ColumnState::chosen) met += a;
      if (states[j] != ColumnState::open) return;
      of_row_.push_back({place[j], static_cast<float>(a)});
      ++column_begin_[place[j] + 1];
    });
    rhs_.push_back(rhs - met);
    row_begin_.push_back(of_row_.size());
  }
  for (std::size_t j = 0; j < column_.size(); ++j) column_begin_[j + 1] += column_begin_[j];
  of_column_.resize(of_row_.size());
  std::vector<std::size_t> next(column_begin_.begin(), column_begin_.end() - 1);
  for (std::uint32_t i = 0; i < rhs_.size(); ++i)
    for (const Term& term : row(i)) of_column_[next[term.index]++] = {i, term.a};
}

}  // namespace shelfbeam::detail
