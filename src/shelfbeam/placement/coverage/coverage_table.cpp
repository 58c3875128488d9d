#include "shelfbeam/placement/coverage/coverage_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "shelfbeam/placement/kernels/search_instance.hpp"

namespace shelfbeam::detail {

namespace {

float rounded_up(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) < value
             ? std::nextafter(rounded, std::numeric_limits<float>::infinity())
             : rounded;
}

}  // namespace

CoverageTable::CoverageTable(const SignalTable& table, const PlacementProblem& problem,
                             const LabelWeights& weights)
    : table_(table), problem_(problem), weights_(weights), mounts_(table) {
  const bool cooperative = problem.model == CommunicationModel::cooperative;
  omits_best_ = cooperative && problem.redundant;
  target_ = cooperative ? static_cast<float>(1 - search_tolerance) : (problem.redundant ? 2.0F : 1.0F);

  std::vector<bool> chosen(table.columns(), false), helps(table.columns(), false);
  for (std::uint32_t j = 0; j < table.columns(); ++j) {
    chosen[j] = table.transceivers[j].installed;
    if (chosen[j]) installed_.push_back(j);
  }
  for (std::uint32_t i = 0; i < table.rows(); ++i) {
    if (weights[i] <= 0) continue;
    const double requirement = requirement_of(table.labels[i], problem.model);
    if (is_met(received_signal(table, i, chosen, problem), requirement)) {
      settled_ += weights[i];
    } else if (is_met(mounts_.max_signal(table.row(i), problem) * (1 + 1e-12), requirement)) {
      rows_.push_back(i);
      for (const SignalEntry& entry : table.row(i)) helps[entry.transceiver] = true;
    }
  }
  std::vector<std::uint32_t> mount(table.columns());
  for (std::uint32_t j = 0; j < table.columns(); ++j) {
    const auto options = mounts_.options(j);
    mount[j] = options.empty() ? j : options.front();
    if (!helps[j] || chosen[j] || !mounts_.available(j)) continue;
    candidates_.push_back(j);
    point_.push_back(mount[j]);
  }
  constexpr std::size_t block = SearchMatrix::block;
  padded_ = (rows_.size() + block - 1) / block * block;
}

bool CoverageTable::exclude_each_other(std::uint32_t candidate, std::uint32_t other) const {
  if (point_[candidate] == point_[other]) return true;
  const auto partners = mounts_.partners(candidates_[candidate]);
  return std::find(partners.begin(), partners.end(), candidates_[other]) != partners.end();
}

double CoverageTable::weight(std::span<const std::uint32_t> selected) const {
  double result = settled_;
  for (const std::uint32_t i : rows_) {
    const auto row = table_.row(i);
    ReceivedSignal received(problem_);
    auto from = row.begin();
    for (const std::uint32_t j : selected) {
      from = std::lower_bound(from, row.end(), j, [](const SignalEntry& entry, std::uint32_t column) {
        return entry.transceiver < column;
      });
      if (from != row.end() && from->transceiver == j) received.add(from->signal);
    }
    if (is_met(received.value(), requirement_of(table_.labels[i], problem_.model))) result += weights_[i];
  }
  return result;
}

std::vector<double> CoverageTable::weights_with_one() const {
  std::vector<double> by_column(table_.columns(), settled_);
  std::vector<bool> chosen(table_.columns(), false);
  for (const std::uint32_t j : installed_) chosen[j] = true;
  std::vector<SignalEntry> present;
  for (const std::uint32_t i : rows_) {
    const auto row = table_.row(i);
    present.clear();
    std::copy_if(row.begin(), row.end(), std::back_inserter(present),
                 [&](const SignalEntry& entry) { return chosen[entry.transceiver]; });
    const double requirement = requirement_of(table_.labels[i], problem_.model);
    for (const SignalEntry& entry : row) {
      if (chosen[entry.transceiver]) continue;
      // In the order of the row, in which the rule adds signals.
      ReceivedSignal received(problem_);
      std::size_t k = 0;
      for (; k < present.size() && present[k].transceiver < entry.transceiver; ++k)
        received.add(present[k].signal);
      received.add(entry.signal);
      for (; k < present.size(); ++k) received.add(present[k].signal);
      if (is_met(received.value(), requirement)) by_column[entry.transceiver] += weights_[i];
    }
  }
  std::vector<double> result;
  for (const std::uint32_t j : candidates_) result.push_back(by_column[j]);
  return result;
}

void CoverageTable::fill() {
  constexpr std::uint32_t none = ~0U;
  std::vector<std::uint32_t> place(table_.columns(), none);
  for (std::uint32_t c = 0; c < candidates_.size(); ++c) place[candidates_[c]] = c;
  for (std::uint32_t u = 0; u < installed_.size(); ++u)
    place[installed_[u]] = static_cast<std::uint32_t>(candidates_.size()) + u;
  matrix_.assign((candidates_.size() + installed_.size()) * padded_, 0.0F);
  const bool cooperative = problem_.model == CommunicationModel::cooperative;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const double requirement = requirement_of(table_.labels[rows_[i]], problem_.model);
    for (const SignalEntry& entry : table_.row(rows_[i])) {
      if (place[entry.transceiver] == none) continue;
      float& signal = matrix_[place[entry.transceiver] * padded_ + i];
      signal = cooperative ? rounded_up(std::min(1.0, entry.signal / requirement))
                           : (is_met(entry.signal, requirement) ? 1.0F : 0.0F);
    }
  }
}

}  // namespace shelfbeam::detail
