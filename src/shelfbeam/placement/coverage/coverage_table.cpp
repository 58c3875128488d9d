#include "shelfbeam/placement/coverage/coverage_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/kernels/search_matrix.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam::detail {

namespace {

float rounded_up(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value
             ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
             : rounded;
}

}  // namespace

CoverageTable::CoverageTable(const Instance& instance, const LabelWeights& weights)
    : instance_(instance), weights_(weights) {
  const bool cooperative = instance.is_cooperative();
  omits_best_ = cooperative && instance.problem.redundant;
  target_ =
      cooperative ? static_cast<float>(1 - search_tolerance) : (instance.problem.redundant ? 2.0F : 1.0F);

  const Mounts& mounts = instance.mounts;
  const std::vector<bool> chosen = marked(instance.columns(), instance.installed);
  std::vector<bool> helps(instance.columns(), false);
  for (std::uint32_t i = 0; i < instance.rows(); ++i) {
    if (weights[i] <= 0) continue;
    if (instance.is_reached(i, chosen)) {
      settled_ += weights[i];
    } else if (mounts.may_meet(instance.row(i), instance.requirement(i), instance.problem)) {
      rows_.push_back(i);
      for (const SignalEntry& entry : instance.row(i)) helps[entry.transceiver] = true;
    }
  }
  candidates_ = numbers_where<ColumnId>(instance.columns(),
                                        [&](ColumnId j) { return helps[j] && instance.available[j]; });
  constexpr std::size_t block = SearchMatrix::block;
  padded_ = (rows_.size() + block - 1) / block * block;
}

bool CoverageTable::exclude_each_other(std::uint32_t candidate, std::uint32_t other) const {
  if (point(candidate) == point(other)) return true;
  const auto partners = instance_.mounts.partners(candidates_[candidate]);
  return std::find(partners.begin(), partners.end(), candidates_[other]) != partners.end();
}

double CoverageTable::weight(std::span<const ColumnId> selected) const {
  double result = settled_;
  for (const LabelId i : rows_) {
    const auto row = instance_.row(i);
    ReceivedSignal received(instance_.problem);
    auto from = row.begin();
    for (const ColumnId j : selected) {
      from = std::ranges::lower_bound(from, row.end(), j, {}, &SignalEntry::transceiver);
      if (from != row.end() && from->transceiver == j) received.add(from->signal);
    }
    if (is_met(received.value(), instance_.requirement(i))) result += weights_[i];
  }
  return result;
}

std::vector<double> CoverageTable::weights_with_one() const {
  std::vector<double> by_column(instance_.columns(), settled_);
  const std::vector<bool> chosen = marked(instance_.columns(), instance_.installed);
  std::vector<SignalEntry> present;
  for (const LabelId i : rows_) {
    const auto row = instance_.row(i);
    present.clear();
    std::copy_if(row.begin(), row.end(), std::back_inserter(present),
                 [&](const SignalEntry& entry) { return chosen[entry.transceiver]; });
    const double requirement = instance_.requirement(i);
    for (const SignalEntry& entry : row) {
      if (chosen[entry.transceiver]) continue;
      // In the order of the row, in which the rule adds signals.
      ReceivedSignal received(instance_.problem);
      std::size_t k = 0;
      for (; k < present.size() && present[k].transceiver < entry.transceiver; ++k)
        received.add(present[k].signal);
      received.add(entry.signal);
      for (; k < present.size(); ++k) received.add(present[k].signal);
      if (is_met(received.value(), requirement)) by_column[entry.transceiver] += weights_[i];
    }
  }
  std::vector<double> result;
  for (const ColumnId j : candidates_) result.push_back(by_column[j]);
  return result;
}

void CoverageTable::fill() {
  constexpr std::uint32_t none = ~0U;
  std::vector<std::uint32_t> place(instance_.columns(), none);
  for (std::uint32_t c = 0; c < candidates_.size(); ++c) place[candidates_[c]] = c;
  for (std::uint32_t u = 0; u < instance_.installed.size(); ++u)
    place[instance_.installed[u]] = static_cast<std::uint32_t>(candidates_.size()) + u;
  matrix_.assign((candidates_.size() + instance_.installed.size()) * padded_, 0.0F);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double requirement = instance_.requirement(rows_[i]);
    for (const SignalEntry& entry : instance_.row(rows_[i])) {
      if (place[entry.transceiver] == none) continue;
      float& signal = matrix_[place[entry.transceiver] * padded_ + i];
      signal = rounded_up(share_of(entry.signal, requirement, instance_.problem));
    }
  }
}

}  // namespace shelfbeam::detail
