#include "shelfbeam/placement/bound/row_pricing.hpp"

#include <algorithm>

#include "shelfbeam/base/parallel.hpp"

namespace shelfbeam::detail {

RowPricing::RowPricing(const SignalTable& table, const Question& question, std::size_t most_units)
    : rows_(table.rows()),
      columns_(table.columns()),
      cover_(table, question, most_units),
      strongest_(rows_, static_cast<std::uint32_t>(columns_)),
      total_(rows_, 0.0) {
  for_parts(rows_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      // By the signal itself: where one unit is enough, a_ij is 1 for many.
      double largest = 0;
      for (const SignalEntry& entry : table.row(i)) {
        if (entry.signal <= largest) continue;
        largest = entry.signal;
        strongest_[i] = entry.transceiver;
      }
      cover_.for_entries(i, [&](std::uint32_t, double a) { total_[i] += a; });
    }
  });
}

std::vector<std::uint32_t> RowPricing::hardest() const {
  constexpr std::uint32_t none = ~std::uint32_t{0};
  std::vector<std::uint32_t> best(columns_ + 1, none);
  for (std::uint32_t i = 0; i < rows_; ++i) {
    std::uint32_t& label = best[strongest_[i]];
    if (label == none || total_[i] < total_[label]) label = i;
  }
  std::erase(best, none);
  std::sort(best.begin(), best.end());
  return best;
}

std::vector<RowPricing::Violated> RowPricing::violated(std::span<const double> x, double tolerance,
                                                       std::size_t most,
                                                       const std::vector<bool>& known) const {
  std::vector<double> lacking(rows_);
  for_parts(rows_, [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      lacking[i] = cover_.bound();
      cover_.for_entries(i, [&](std::uint32_t j, double a) { lacking[i] -= a * x[j]; });
    }
  });
  std::vector<Violated> worst(columns_ + 1);
  for (std::uint32_t i = 0; i < rows_; ++i)
    if (!known[i] && lacking[i] > worst[strongest_[i]].by) worst[strongest_[i]] = {lacking[i], i};
  std::erase_if(worst, [&](const Violated& row) { return row.by <= tolerance; });
  std::sort(worst.begin(), worst.end(), [](const Violated& a, const Violated& b) {
    return a.by != b.by ? a.by > b.by : a.label < b.label;
  });
  worst.resize(std::min(worst.size(), most));
  return worst;
}

}  // namespace shelfbeam::detail
