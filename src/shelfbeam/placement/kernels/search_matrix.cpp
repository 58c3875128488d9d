#include "shelfbeam/placement/kernels/search_matrix.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/kernels/search_kernels.hpp"

namespace shelfbeam::detail {

namespace {

// Ratios are capped here, so that sums stay finite.
constexpr float largest = 1e6F;
// The largest float below 1, for links that fail the rule by less than rounding.
constexpr float just_short = 1 - std::numeric_limits<float>::epsilon() / 2;

}  // namespace

SearchMatrix::SearchMatrix(const Instance& instance, std::vector<LabelId> rows)
    : rows_(std::move(rows)),
      padded_((rows_.size() + block - 1) / block * block),
      columns_(instance.columns()),
      values_(padded_ * columns_, 0.0F) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double requirement = instance.requirement(rows_[i]);
    for (const SignalEntry& entry : instance.row(rows_[i])) {
      float& value = values_[entry.transceiver * padded_ + i];
      value = static_cast<float>(std::min(entry.signal / requirement, static_cast<double>(largest)));
      if (!instance.is_cooperative() && !is_met(entry.signal, requirement))
        value = std::min(value, just_short);
    }
  }
}

SearchMatrix::SearchMatrix(const Instance& instance)
    : SearchMatrix(instance, all_numbers<LabelId>(instance.rows())) {}

Receiving receiving(const PlacementProblem& problem) {
  if (problem.model == CommunicationModel::cooperative)
    return problem.redundant ? Receiving::sum_without_best : Receiving::sum;
  return problem.redundant ? Receiving::second_best : Receiving::best;
}

Margin margin_of(const Instance& instance, const SearchMatrix& all, std::span<const ColumnId> selected,
                 std::vector<float>& received) {
  Margin margin{std::numeric_limits<double>::infinity(), 0, true};
  received.assign(2 * all.padded_rows(), 0.0F);
  const Receiving rule = receiving(instance.problem);
  float* const value = received.data();
  float* const best = received.data() + all.padded_rows();
  for (const ColumnId j : selected)
    SearchKernels::receive(rule, all.column(j), all.padded_rows(), value, best);
  float smallest = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < all.rows(); ++i) smallest = std::min(smallest, received[i]);
  const std::vector<bool> chosen = marked(instance.columns(), selected);
  double of_unmet = std::numeric_limits<double>::infinity();
  // These rows include the smallest margin in double precision, and a missed label if there is any. (Capped
  // ratios cannot be told apart.)
  const float lowest = smallest < largest / 10 ? smallest * (1 + 5 * static_cast<float>(search_tolerance))
                                               : std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < all.rows(); ++i) {
    if (received[i] > lowest) continue;
    const double requirement = instance.requirement(i);
    const double signal = instance.received(i, chosen);
    const double ratio = signal / requirement;
    const bool met = is_met(signal, requirement);
    // One of two labels with equal rounded ratios may be reached. The missed label is reported.
    if (margin.is_met ? !met || ratio < margin.smallest : !met && ratio < of_unmet) margin.label = i;
    if (!met) of_unmet = std::min(of_unmet, ratio);
    margin.is_met = margin.is_met && met;
    margin.smallest = std::min(margin.smallest, ratio);
  }
  return margin;
}

}  // namespace shelfbeam::detail
