#include "shelfbeam/placement/detail/search_matrix.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include "shelfbeam/placement/detail/search_kernels.hpp"

namespace shelfbeam::detail {

namespace {

// Larger ratios are as good as this one, and sums of them stay finite.
constexpr double largest = 1e6;

std::vector<std::uint32_t> all_rows(const SignalTable& table) {
  std::vector<std::uint32_t> rows(table.rows());
  std::iota(rows.begin(), rows.end(), 0U);
  return rows;
}

}  // namespace

SearchMatrix::SearchMatrix(const SignalTable& table, CommunicationModel model,
                           std::vector<std::uint32_t> rows)
    : rows_(std::move(rows)),
      padded_((rows_.size() + block - 1) / block * block),
      columns_(table.columns()),
      values_(padded_ * columns_, 0.0F) {
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double requirement = requirement_of(table.labels[rows_[i]], model);
    for (const SignalEntry& entry : table.row(rows_[i]))
      values_[entry.transceiver * padded_ + i] =
          static_cast<float>(std::min(entry.signal / requirement, largest));
  }
}

SearchMatrix::SearchMatrix(const SignalTable& table, CommunicationModel model)
    : SearchMatrix(table, model, all_rows(table)) {}

Receiving receiving(const Question& question) {
  if (question.model == CommunicationModel::cooperative)
    return question.redundant ? Receiving::sum_without_best : Receiving::sum;
  return question.redundant ? Receiving::second_best : Receiving::best;
}

Margin margin_of(const SignalTable& table, const Question& question, const SearchMatrix& all,
                 std::span<const std::uint32_t> selected, std::vector<float>& received) {
  Margin margin{std::numeric_limits<double>::infinity(), 0, true};
  received.assign(2 * all.padded_rows(), 0.0F);
  const Receiving rule = receiving(question);
  float* const value = received.data();
  float* const best = received.data() + all.padded_rows();
  for (const std::uint32_t j : selected)
    SearchKernels::receive(rule, all.column(j), all.padded_rows(), value, best);
  float least = std::numeric_limits<float>::infinity();
  for (std::size_t i = 0; i < all.rows(); ++i) least = std::min(least, received[i]);
  std::vector<bool> chosen(table.columns(), false);
  for (const std::uint32_t j : selected) chosen[j] = true;
  // The smallest in truth is among these, and whoever is not met if any is.
  const float lowest = least * (1 + 5 * static_cast<float>(search_tolerance));
  for (std::uint32_t i = 0; i < all.rows(); ++i) {
    if (received[i] > lowest) continue;
    const double requirement = requirement_of(table.labels[i], question.model);
    const double signal = received_signal(table, i, chosen, question);
    margin.is_met = margin.is_met && is_met(signal, requirement);
    if (signal / requirement < margin.smallest) {
      margin.smallest = signal / requirement;
      margin.label = i;
    }
  }
  return margin;
}

}  // namespace shelfbeam::detail
