#include "shelfbeam/placement/coverage/least_useful.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam::detail {

std::optional<LeastUseful> least_useful(const Instance& instance, const LabelWeights& weights,
                                        const Selection& selected) {
  const std::vector<bool> chosen = marked(instance.columns(), selected);
  std::vector<double> missed(instance.columns(), 0.0), lost(instance.columns(), 0.0);
  for (std::size_t i = 0; i < instance.rows(); ++i) {
    const double requirement = instance.requirement(i);
    LabelShares shares;
    for (const SignalEntry& entry : instance.row(i))
      if (chosen[entry.transceiver])
        shares.add(entry.transceiver, share_of(entry.signal, requirement, instance.problem));
    const double before = lacking(shares.sum, shares.largest, instance.problem);
    for (const SignalEntry& entry : instance.row(i)) {
      const std::uint32_t j = entry.transceiver;
      if (!chosen[j]) continue;
      const double rest = std::max(0.0, shares.sum - share_of(entry.signal, requirement, instance.problem));
      const double after = lacking(rest, shares.largest_without(j), instance.problem);
      lost[j] += weights[i] * (after - before);
      if (before == 0 && after > 0) missed[j] += weights[i];
    }
  }
  std::optional<ColumnId> least;
  for (const ColumnId j : selected)
    if (!instance.is_installed(j) &&
        (!least || std::pair(missed[j], lost[j]) < std::pair(missed[*least], lost[*least])))
      least = j;
  if (!least) return {};
  return LeastUseful{*least, missed[*least]};
}

Selection without_useless(const Instance& instance, const LabelWeights& weights, Selection selected,
                          const Effort& effort, const RunControl& control) {
  const double reached = weight_of(instance, weights, selected);
  while (!effort.is_over(control)) {
    const auto least = least_useful(instance, weights, selected);
    if (!least || least->weight > 0) break;
    Selection fewer = selected;
    std::erase(fewer, least->column);
    // Shares decide almost as the checker does.
    if (weight_of(instance, weights, fewer) < reached) break;
    selected = std::move(fewer);
  }
  return selected;
}

Selection first_units(std::span<const ColumnId> order, std::size_t units) {
  return sorted(order.first(std::min(order.size(), units)));
}

double weight_of(const Instance& instance, const LabelWeights& weights, const Selection& selected) {
  return weights.without(instance.check(selected).unmet);
}

}  // namespace shelfbeam::detail
