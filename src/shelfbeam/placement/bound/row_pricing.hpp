#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// Finds label rows that a fractional selection violates, spread over the shop: labels with the same
/// strongest unit are neighbours, and one of them per round is enough.
class RowPricing {
 public:
  /// For selections of at most `max_units` units.
  RowPricing(const Instance& instance, std::size_t max_units)
      : rows_(instance.rows()),
        columns_(instance.columns()),
        cover_(instance, max_units),
        strongest_(rows_, static_cast<std::uint32_t>(columns_)),
        total_(rows_, 0.0) {
    parallel_for_ranges(rows_, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        // Compared by signal, because a_ij is 1 for many units if one unit is enough.
        double largest = 0;
        for (const SignalEntry& entry : instance.row(i)) {
          if (entry.signal <= largest) continue;
          largest = entry.signal;
          strongest_[i] = entry.transceiver;
        }
        cover_.for_entries(i, [&](std::uint32_t, double a) { total_[i] += a; });
      }
    });
  }

  /// For every strongest unit, the label with the smallest sum_j a_ij, ascending.
  std::vector<LabelId> hardest() const {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    std::vector<LabelId> best(columns_ + 1, none);
    for (std::uint32_t i = 0; i < rows_; ++i) {
      LabelId& label = best[strongest_[i]];
      if (label == none || total_[i] < total_[label]) label = i;
    }
    std::erase(best, none);
    std::sort(best.begin(), best.end());
    return best;
  }

  struct Violated {
    double by = 0;
    LabelId label;
  };
  /// The labels that `x` violates by more than `tolerance`: the most violated per strongest unit, in
  /// descending order, at most `max_cuts`, without `known` labels. Scans the table once on the threads of the
  /// current arena.
  std::vector<Violated> violated(std::span<const double> x, double tolerance, std::size_t max_cuts,
                                 const std::vector<bool>& known) const {
    std::vector<double> lacking(rows_);
    parallel_for_ranges(rows_, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        lacking[i] = cover_.bound(i);
        cover_.for_entries(i, [&](std::uint32_t j, double a) { lacking[i] -= a * x[j]; });
      }
    });
    std::vector<Violated> worst(columns_ + 1);
    for (std::uint32_t i = 0; i < rows_; ++i)
      if (!known[i] && lacking[i] > worst[strongest_[i]].by) worst[strongest_[i]] = {lacking[i], i};
    std::erase_if(worst, [&](const Violated& row) { return row.by <= tolerance; });
    std::ranges::sort(worst, {}, [](const Violated& row) { return std::pair(-row.by, row.label); });
    worst.resize(std::min(worst.size(), max_cuts));
    return worst;
  }

 private:
  std::size_t rows_;
  std::size_t columns_;
  CoverRows cover_;
  std::vector<std::uint32_t> strongest_;  ///< per label; columns_ if no unit reaches it
  std::vector<double> total_;             ///< per label: sum_j a_ij
};

}  // namespace shelfbeam::detail
