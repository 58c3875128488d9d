#include "shelfbeam/placement/problem/mounts.hpp"

#include <algorithm>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

double Mounts::max_signal(std::span<const SignalEntry> row, const PlacementProblem& problem) const {
  std::vector<std::uint32_t> best(shared_.size(), alone);  // per mounting point: index into the row
  std::vector<bool> chosen(mount_.size(), false);
  for (std::uint32_t k = 0; k < row.size(); ++k) {
    if (!available_[row[k].transceiver]) continue;
    const std::uint32_t mount = mount_[row[k].transceiver];
    if (mount == alone)
      chosen[row[k].transceiver] = true;
    else if (best[mount] == alone || row[k].signal > row[best[mount]].signal)
      best[mount] = k;
  }
  for (const std::uint32_t k : best)
    if (k != alone) chosen[row[k].transceiver] = true;
  return received_signal(row, chosen, problem);
}

std::vector<std::uint32_t> shared_mounts(const SignalTable& table, const std::vector<bool>& chosen) {
  return numbers_where(table.mounts.size(), [&](std::uint32_t k) {
    return std::ranges::count_if(table.mounts[k], [&](ColumnId j) { return chosen[j]; }) > 1;
  });
}

std::vector<std::uint32_t> conflicting_pairs(const SignalTable& table, const std::vector<bool>& chosen) {
  return numbers_where(table.conflicts.size(), [&](std::uint32_t k) {
    return chosen[table.conflicts[k].first] && chosen[table.conflicts[k].second];
  });
}

}  // namespace shelfbeam
