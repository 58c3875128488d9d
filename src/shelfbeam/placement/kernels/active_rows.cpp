#include "shelfbeam/placement/kernels/active_rows.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/math/order.hpp"

namespace shelfbeam::detail {

ActiveRows::ActiveRows(const SearchMatrix& all, Receiving rule)
    : all_(all), rule_(rule), is_known_(all.rows(), false), values_(all.columns()) {}

float ActiveRows::used_of(LabelId row, ColumnId column) const {
  const float ratio = all_.column(column)[row];
  if (is_sum(rule_)) return std::min(ratio, 1.0F);
  return ratio >= 1.0F ? 1.0F : 0.0F;
}

void ActiveRows::take(std::span<const LabelId> rows) {
  for (const LabelId row : rows) {
    rows_.push_back(row);
    is_known_[row] = true;
  }
  values_.add_rows(rows.size(), [&](std::size_t k, std::size_t j) {
    return used_of(rows[k], static_cast<std::uint32_t>(j));
  });
}

void ActiveRows::add_hardest(std::span<const ColumnId> selected, std::size_t count) {
  std::vector<std::pair<float, LabelId>> by_sum;
  for (std::uint32_t i = 0; i < all_.rows(); ++i) {
    if (is_known_[i]) continue;
    float sum = 0;
    for (const ColumnId j : selected) sum += used_of(i, j);
    by_sum.emplace_back(sum, i);
  }
  take_weakest(by_sum, count);
}

void ActiveRows::take_weakest(std::vector<std::pair<float, LabelId>>& by_received, std::size_t count) {
  const auto end = by_received.begin() + static_cast<std::ptrdiff_t>(std::min(count, by_received.size()));
  std::partial_sort(by_received.begin(), end, by_received.end());
  std::vector<LabelId> rows;
  for (auto one = by_received.begin(); one != end; ++one) rows.push_back(one->second);
  take(rows);
}

bool ActiveRows::add_missed(std::span<const float> received, LabelId label) {
  constexpr std::size_t at_once = 32;
  std::vector<std::pair<float, LabelId>> short_of;
  for (std::uint32_t i = 0; i < all_.rows(); ++i)
    if (received[i] < 1 && !is_known_[i]) short_of.emplace_back(received[i], i);
  // Single precision accepts every row.
  if (short_of.empty() && !is_known_[label]) short_of.emplace_back(received[label], label);
  take_weakest(short_of, at_once);
  return !short_of.empty();
}

void ActiveRows::add_all() {
  take(all_numbers<LabelId>(all_.rows()));
}

void ActiveRows::tighten(LabelId label) {
  constexpr float less = 1 - 1e-4F;
  const auto r = static_cast<std::size_t>(std::find(rows_.begin(), rows_.end(), label) - rows_.begin());
  for (std::size_t j = 0; j < all_.columns(); ++j) values_.at(r, j) *= less;
}

}  // namespace shelfbeam::detail
