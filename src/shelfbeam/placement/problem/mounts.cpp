#include "shelfbeam/placement/problem/mounts.hpp"

#include <algorithm>

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
  std::vector<std::uint32_t> crowded;
  for (std::uint32_t k = 0; k < table.mounts.size(); ++k) {
    const auto units = std::count_if(table.mounts[k].begin(), table.mounts[k].end(),
                                     [&](std::uint32_t j) { return chosen[j]; });
    if (units > 1) crowded.push_back(k);
  }
  return crowded;
}

std::vector<std::uint32_t> conflicting_pairs(const SignalTable& table, const std::vector<bool>& chosen) {
  std::vector<std::uint32_t> broken;
  for (std::uint32_t k = 0; k < table.conflicts.size(); ++k)
    if (chosen[table.conflicts[k].first] && chosen[table.conflicts[k].second]) broken.push_back(k);
  return broken;
}

}  // namespace shelfbeam
