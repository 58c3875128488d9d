#include "shelfbeam/placement/heuristic/greedy.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam {

namespace {

class Greedy {
 public:
  Greedy(const detail::Instance& instance, std::span<const double> weight)
      : instance_(instance),
        weight_(weight),
        cost_(instance.first_cost),
        chosen_(instance.columns(), false),
        blocked_by_(instance.columns(), 0) {
    if (instance.problem.combination == Combination::lexicographic)
      for (std::size_t j = 0; j < cost_.size(); ++j) cost_[j] += instance.second_cost[j];
    for (const ColumnId j : instance.installed) choose(j);
    look_at_every_label();
  }

  std::vector<ColumnId> run(const detail::Effort& effort, const RunControl& control) {
    for (std::uint64_t step = 0;; ++step) {
      if (step >= effort.steps || effort.is_over(control)) {
        reach_each_label();
        break;
      }
      const std::vector<double> gain = gains();
      if (unmet_.empty()) break;
      auto best = static_cast<std::uint32_t>(instance_.columns());
      double best_ratio = std::numeric_limits<double>::infinity();
      for (std::uint32_t j = 0; j < instance_.columns(); ++j) {
        if (chosen_[j] || blocked_by_[j] > 0 || gain[j] <= 0) continue;
        const double ratio = cost_[j] / gain[j];
        if (best == instance_.columns() || ratio < best_ratio) {
          best = j;
          best_ratio = ratio;
        }
      }
      if (best < instance_.columns())
        choose(best);
      else if (!exchange())
        break;
    }
    return std::move(order_);
  }

 private:
  /// Exchange of a chosen unit for a column that only this unit blocks.
  struct Exchange {
    std::uint32_t out = 0, in = 0;
    double lacking = 0;  ///< change of the total lack
  };

  void choose(ColumnId column) {
    order_.push_back(column);
    chosen_[column] = true;
    for (const ColumnId other : instance_.excludes[column]) ++blocked_by_[other];
  }

  void drop(ColumnId column) {
    order_.erase(std::find(order_.begin(), order_.end(), column));
    chosen_[column] = false;
    for (const ColumnId other : instance_.excludes[column]) --blocked_by_[other];
  }

  double weight(std::size_t label) const { return weight_.empty() ? 1 : weight_[label]; }

  void look_at_every_label() {
    unmet_ = numbers_where<LabelId>(instance_.rows(), [&](LabelId i) { return weight(i) > 0; });
  }

  double share(const SignalEntry& entry, double requirement) const {
    return detail::share_of(entry.signal, requirement, instance_.problem);
  }

  std::vector<Exchange> exchanges() const {
    std::vector<Exchange> result;
    for (std::uint32_t j = 0; j < instance_.columns(); ++j) {
      if (!chosen_[j] || instance_.is_installed(j)) continue;
      for (const ColumnId other : instance_.excludes[j])
        if (!chosen_[other] && blocked_by_[other] == 1) result.push_back({j, other, 0});
    }
    return result;
  }

  // Makes the exchange that reduces the total lack most; false if none reduces it.
  bool exchange() {
    constexpr double min_help = 1e-9;  // keeps rounding from causing endless exchanges
    std::vector<Exchange> all = exchanges();
    std::vector<double> part(instance_.columns(), 0.0);
    for (std::size_t i = 0; i < instance_.rows(); ++i) {
      const double requirement = instance_.requirement(i);
      detail::LabelShares now;
      for (const SignalEntry& entry : instance_.row(i)) {
        part[entry.transceiver] = share(entry, requirement);
        if (chosen_[entry.transceiver]) now.add(entry.transceiver, part[entry.transceiver]);
      }
      const double before = detail::lacking(now.sum, now.largest, instance_.problem);
      for (Exchange& one : all) {
        const double largest = std::max(now.largest_without(one.out), part[one.in]);
        const double sum = now.sum - part[one.out] + part[one.in];
        one.lacking += weight(i) * (detail::lacking(sum, largest, instance_.problem) - before);
      }
      for (const SignalEntry& entry : instance_.row(i)) part[entry.transceiver] = 0;
    }
    const auto best = std::ranges::min_element(all, {}, &Exchange::lacking);
    if (best == all.end() || best->lacking > -min_help) return false;
    drop(best->out);
    choose(best->in);
    look_at_every_label();
    return true;
  }

  // Adds the strongest units of each missed label until it is reached, or none if they do not suffice.
  void reach_each_label() {
    std::vector<SignalEntry> strongest;
    std::vector<ColumnId> added;
    for (const LabelId i : unmet_) {
      const double requirement = instance_.requirement(i);
      if (instance_.is_reached(i, chosen_)) continue;
      if (!instance_.mounts.may_meet(instance_.row(i), requirement, instance_.problem)) continue;
      strongest.clear();
      added.clear();
      for (const SignalEntry& entry : instance_.row(i))
        if (!chosen_[entry.transceiver] && share(entry, requirement) > 0) strongest.push_back(entry);
      std::ranges::stable_sort(strongest, std::greater{}, &SignalEntry::signal);
      bool is_reached = false;
      for (const SignalEntry& entry : strongest) {
        if (blocked_by_[entry.transceiver] > 0) continue;
        choose(entry.transceiver);
        added.push_back(entry.transceiver);
        is_reached = instance_.is_reached(i, chosen_);
        if (is_reached) break;
      }
      if (!is_reached)
        for (const ColumnId j : added) drop(j);
    }
  }

  // The gain of every column (greedy.hpp); removes labels that are reached by now.
  std::vector<double> gains() {
    std::vector<double> gain(instance_.columns(), 0.0);
    std::erase_if(unmet_, [&](LabelId i) {
      const double requirement = instance_.requirement(i);
      const double received = instance_.received(i, chosen_);
      if (is_met(received, requirement)) return true;
      const double lacking = instance_.is_cooperative() ? 1 - received / requirement : 1;
      // A new strongest unit adds a signal that may fail, but restores that of the previous strongest unit.
      double largest = std::numeric_limits<double>::infinity();
      if (instance_.problem.redundant) {
        largest = 0;
        for (const SignalEntry& entry : instance_.row(i))
          if (chosen_[entry.transceiver]) largest = std::max(largest, share(entry, requirement));
      }
      for (const SignalEntry& entry : instance_.row(i)) {
        const double part = share(entry, requirement);
        gain[entry.transceiver] += weight(i) * std::min(part, lacking + std::max(0.0, part - largest));
      }
      return false;
    });
    return gain;
  }

  const detail::Instance& instance_;
  std::span<const double> weight_;  ///< per label; empty: 1
  std::vector<double> cost_;
  std::vector<ColumnId> order_;  ///< the chosen units, in the order of their addition
  std::vector<bool> chosen_;
  std::vector<std::uint32_t> blocked_by_;  ///< per column: chosen units in conflict with it
  std::vector<LabelId> unmet_;
};

}  // namespace

Selection greedy_selection(const detail::Instance& instance, const detail::Effort& effort,
                           const RunControl& control) {
  return sorted(greedy_order(instance, {}, effort, control));
}

std::vector<ColumnId> greedy_order(const detail::Instance& instance, std::span<const double> weight,
                                   const detail::Effort& effort, const RunControl& control) {
  return Greedy(instance, weight).run(effort, control);
}

}  // namespace shelfbeam
