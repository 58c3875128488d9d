#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

/// Conflicts between candidates: a mounting point holds at most one unit, and forbidden pairs must not both
/// be chosen. Installed units stay, so candidates in conflict with them are not available.
class Mounts {
 public:
  explicit Mounts(const SignalTable& table) : Mounts(table.mounts, table.transceivers, table.conflicts) {}

  /// `shared` is SignalTable::mounts, `conflicts` SignalTable::conflicts; `units` are the columns, each with
  /// members `installed` and `pinned`.
  template <class Units>
  Mounts(std::vector<std::vector<ColumnId>> shared, const Units& units,
         std::span<const std::pair<ColumnId, ColumnId>> conflicts = {})
      : shared_(std::move(shared)),
        mount_(units.size(), alone),
        available_(units.size(), true),
        partners_(units.size()) {
    for (std::uint32_t k = 0; k < shared_.size(); ++k) {
      bool taken = false;
      for (const ColumnId j : shared_[k]) {
        mount_[j] = k;
        taken = taken || is_given(units[j]);
      }
      for (const ColumnId j : shared_[k]) available_[j] = !taken || is_given(units[j]);
    }
    for (const auto& [a, b] : conflicts) {
      partners_[a].push_back(b);
      partners_[b].push_back(a);
      if (is_given(units[a])) available_[b] = false;
      if (is_given(units[b])) available_[a] = false;
    }
  }

  /// The options of the column's mounting point, including the column; empty if the point is not shared.
  std::span<const ColumnId> options(ColumnId column) const {
    return mount_[column] == alone ? std::span<const ColumnId>() : shared_[mount_[column]];
  }
  /// The first option of the column's mounting point, the same for all of them; the column itself if the
  /// point is not shared.
  std::uint32_t first_option(ColumnId column) const {
    return mount_[column] == alone ? column : shared_[mount_[column]].front();
  }
  /// The columns that form a forbidden pair with this column.
  std::span<const ColumnId> partners(ColumnId column) const { return partners_[column]; }
  /// Calls `visit` with every column in conflict with this column; twice with an option of the same mounting
  /// point that also forms a forbidden pair with it.
  template <class Visit>
  void for_each_conflict(ColumnId column, const Visit& visit) const {
    for (const ColumnId j : options(column))
      if (j != column) visit(j);
    for (const ColumnId j : partners(column)) visit(j);
  }
  /// The column is not in conflict with an installed unit.
  bool available(ColumnId column) const { return available_[column]; }

  /// Upper bound on received_signal for a label with `row` (SignalTable::row), apart from rounding: all
  /// available units, but only the best option of every mounting point. Forbidden pairs without an installed
  /// unit are ignored.
  double max_signal(std::span<const SignalEntry> row, const PlacementProblem& problem) const;
  /// Whether max_signal meets a requirement, with room for the rounding of sums in another order.
  bool may_meet(std::span<const SignalEntry> row, double requirement, const PlacementProblem& problem) const {
    constexpr double rounding = 1 + 1e-12;
    return is_met(max_signal(row, problem) * rounding, requirement);
  }

 private:
  // Columns of tables that are pinned are also installed; those of matrices are not.
  template <class Unit>
  static bool is_given(const Unit& unit) {
    return unit.installed || unit.pinned;
  }

  static constexpr std::uint32_t alone = ~std::uint32_t{0};

  std::vector<std::vector<ColumnId>> shared_;
  std::vector<std::uint32_t> mount_;  ///< index into `shared_`, or alone
  std::vector<bool> available_;
  std::vector<std::vector<ColumnId>> partners_;
};

/// Indices into SignalTable::mounts of the points with two or more chosen columns, ascending.
std::vector<std::uint32_t> shared_mounts(const SignalTable& table, const std::vector<bool>& chosen);

/// Indices into SignalTable::conflicts of the pairs with both columns chosen, ascending.
std::vector<std::uint32_t> conflicting_pairs(const SignalTable& table, const std::vector<bool>& chosen);

}  // namespace shelfbeam
