#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// Which candidates exclude one another: a mounting point holds at most one unit, and some pairs must not be
/// chosen together. An installed unit stays, so what it excludes is not available.
class Mounts {
 public:
  explicit Mounts(const SignalTable& table) : Mounts(table.mounts, table.transceivers, table.apart) {}

  /// `shared` as SignalTable::mounts and `apart` as SignalTable::apart; `units` are the columns, each with a
  /// member `installed`.
  template <class Units>
  Mounts(std::vector<std::vector<std::uint32_t>> shared, const Units& units,
         std::span<const std::pair<std::uint32_t, std::uint32_t>> apart = {})
      : shared_(std::move(shared)),
        mount_(units.size(), alone),
        available_(units.size(), true),
        partners_(units.size()) {
    for (std::uint32_t k = 0; k < shared_.size(); ++k) {
      bool taken = false;
      for (const std::uint32_t j : shared_[k]) {
        mount_[j] = k;
        taken = taken || units[j].installed;
      }
      for (const std::uint32_t j : shared_[k]) available_[j] = !taken || units[j].installed;
    }
    for (const auto& [a, b] : apart) {
      partners_[a].push_back(b);
      partners_[b].push_back(a);
      if (units[a].installed) available_[b] = false;
      if (units[b].installed) available_[a] = false;
    }
  }

  /// The options of the column's point, itself among them; empty where it has the point to itself.
  std::span<const std::uint32_t> options(std::uint32_t column) const {
    return mount_[column] == alone ? std::span<const std::uint32_t>() : shared_[mount_[column]];
  }
  /// The columns that must not be chosen with it, mounting points aside.
  std::span<const std::uint32_t> partners(std::uint32_t column) const { return partners_[column]; }
  /// Calls `visit` with every column that cannot be chosen with this one; twice where a pair of one mounting
  /// point is kept apart, too.
  template <class Visit>
  void for_each_excluded(std::uint32_t column, const Visit& visit) const {
    for (const std::uint32_t j : options(column))
      if (j != column) visit(j);
    for (const std::uint32_t j : partners(column)) visit(j);
  }
  /// No installed unit excludes it.
  bool available(std::uint32_t column) const { return available_[column]; }

  /// The most that a label could get, as received_signal counts it: from the best option of every point
  /// together (cooperative), or from the best candidate; of a redundant question without the best of those.
  /// `row` as SignalTable::row. No selection gives more, but for the rounding of sums; pairs that must be
  /// kept apart are let pass unless one of them is installed.
  double most_signal(std::span<const SignalEntry> row, const Question& question) const;

 private:
  static constexpr std::uint32_t alone = ~std::uint32_t{0};

  std::vector<std::vector<std::uint32_t>> shared_;
  std::vector<std::uint32_t> mount_;  ///< index into `shared_`, or alone
  std::vector<bool> available_;
  std::vector<std::vector<std::uint32_t>> partners_;
};

/// The points that hold two or more of the chosen columns (indices into SignalTable::mounts), ascending.
std::vector<std::uint32_t> crowded_mounts(const SignalTable& table, const std::vector<bool>& chosen);

/// The pairs of which both columns are chosen (indices into SignalTable::apart), ascending.
std::vector<std::uint32_t> broken_pairs(const SignalTable& table, const std::vector<bool>& chosen);

}  // namespace shelfbeam
