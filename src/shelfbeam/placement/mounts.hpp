#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/placement/instance.hpp"

namespace shelfbeam {

/// Which candidates exclude one another: a mounting point holds at most one unit, and keeps an installed one.
class Mounts {
 public:
  explicit Mounts(const SignalTable& table) : Mounts(table.mounts, table.transceivers) {}

  /// `shared` as SignalTable::mounts; `units` are the columns, each with a member `installed`.
  template <class Units>
  Mounts(std::vector<std::vector<std::uint32_t>> shared, const Units& units)
      : shared_(std::move(shared)), mount_(units.size(), alone), available_(units.size(), true) {
    for (std::uint32_t k = 0; k < shared_.size(); ++k) {
      bool taken = false;
      for (const std::uint32_t j : shared_[k]) {
        mount_[j] = k;
        taken = taken || units[j].installed;
      }
      for (const std::uint32_t j : shared_[k]) available_[j] = !taken || units[j].installed;
    }
  }

  /// The options of the column's point, itself among them; empty where it has the point to itself.
  std::span<const std::uint32_t> options(std::uint32_t column) const {
    return mount_[column] == alone ? std::span<const std::uint32_t>() : shared_[mount_[column]];
  }
  /// No other unit is installed at its point.
  bool available(std::uint32_t column) const { return available_[column]; }

  /// The most that a label could get: from the best option of every point together (cooperative), or from the
  /// best candidate. `row` as SignalTable::row. No selection gives more, but for the rounding of sums.
  double most_signal(std::span<const SignalEntry> row, CommunicationModel model) const;

 private:
  static constexpr std::uint32_t alone = ~std::uint32_t{0};

  std::vector<std::vector<std::uint32_t>> shared_;
  std::vector<std::uint32_t> mount_;  ///< index into `shared_`, or alone
  std::vector<bool> available_;
};

/// The points that hold two or more of the chosen columns (indices into SignalTable::mounts), ascending.
std::vector<std::uint32_t> crowded_mounts(const SignalTable& table, const std::vector<bool>& chosen);

}  // namespace shelfbeam
