#include "shelfbeam/placement/mounts.hpp"

#include <algorithm>

namespace shelfbeam {

double Mounts::most_signal(std::span<const SignalEntry> row, CommunicationModel model) const {
  std::vector<double> best(shared_.size(), 0.0);
  double sum = 0, largest = 0;
  for (const SignalEntry& entry : row) {
    if (!available_[entry.transceiver]) continue;
    largest = std::max(largest, entry.signal);
    const std::uint32_t mount = mount_[entry.transceiver];
    if (mount == alone)
      sum += entry.signal;
    else
      best[mount] = std::max(best[mount], entry.signal);
  }
  if (model == CommunicationModel::non_cooperative) return largest;
  for (const double signal : best) sum += signal;
  return sum;
}

std::vector<std::uint32_t> crowded_mounts(const SignalTable& table, const std::vector<bool>& chosen) {
  std::vector<std::uint32_t> crowded;
  for (std::uint32_t k = 0; k < table.mounts.size(); ++k) {
    const auto units = std::count_if(table.mounts[k].begin(), table.mounts[k].end(),
                                     [&](std::uint32_t j) { return chosen[j]; });
    if (units > 1) crowded.push_back(k);
  }
  return crowded;
}

}  // namespace shelfbeam
