#include "shelfbeam/placement/states/state_cuts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <fmt/format.h>

namespace shelfbeam {

namespace {

constexpr double violated = 1 - 1e-6;

}  // namespace

StateCuts::StateCuts(const StateTable& states, const PlacementProblem& problem,
                     std::span<const std::uint32_t> allowed)
    : states_(states), problem_(problem), allowed_(allowed) {
  table_ = states.table;
  table_.labels.clear();
  table_.scenarios.clear();
  table_.entries.clear();
  table_.row_begin = {0};
  std::vector<std::uint32_t> all(states.states);
  std::iota(all.begin(), all.end(), 0U);
  for (std::size_t i = 0; i < states.table.rows(); ++i)
    if (allowed[i] < states.states) append(i, mean_of_largest(i, all));
}

// Clipped at 1; in the non-cooperative model 0 or 1.
double StateCuts::share(std::size_t label, std::size_t state, std::uint32_t column) const {
  const double requirement = requirement_of(states_.table.labels[label], problem_.model);
  const auto signal = static_cast<double>(states_.row(label, state)[column]);
  if (problem_.model == CommunicationModel::cooperative) return std::min(1.0, signal / requirement);
  return is_met(signal, requirement) ? 1 : 0;
}

// Of every column: the mean of the t - k largest shares in t states.
std::vector<double> StateCuts::mean_of_largest(std::size_t label,
                                               std::span<const std::uint32_t> order) const {
  const std::size_t kept = order.size() - allowed_[label];
  std::vector<double> result(states_.table.columns()), shares(order.size());
  for (std::uint32_t j = 0; j < result.size(); ++j) {
    for (std::size_t s = 0; s < order.size(); ++s) shares[s] = share(label, order[s], j);
    const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(kept);
    std::nth_element(shares.begin(), middle - 1, shares.end(), std::greater<>());
    result[j] = std::accumulate(shares.begin(), middle, 0.0) / static_cast<double>(kept);
  }
  return result;
}

double StateCuts::left_side(const std::vector<double>& shares,
                            std::span<const std::uint32_t> selected) const {
  double sum = 0, largest = 0;
  for (const std::uint32_t j : selected) {
    sum += shares[j];
    largest = std::max(largest, shares[j]);
  }
  return problem_.redundant ? sum - largest : sum;
}

// Over the states in which the selection gives the label least, as many as make the left side smallest.
std::vector<double> StateCuts::violated_cut(std::size_t label,
                                            std::span<const std::uint32_t> selected) const {
  std::vector<double> received(states_.states);
  for (std::size_t s = 0; s < received.size(); ++s)
    received[s] = shelfbeam::received_signal(states_.row(label, s), selected, problem_);
  std::vector<std::uint32_t> order(states_.states);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return received[a] < received[b]; });
  std::vector<double> best;
  double least = violated;
  for (std::size_t t = allowed_[label] + 1; t <= order.size(); ++t) {
    std::vector<double> shares = mean_of_largest(label, std::span(order).first(t));
    const double left = left_side(shares, selected);
    if (left >= least) continue;
    least = left;
    best = std::move(shares);
  }
  return best;
}

// Extends the selection to a large set of units with which the label is still missed too often.
std::vector<double> StateCuts::cover_cut(std::size_t label, std::span<const std::uint32_t> selected) const {
  if (problem_.redundant) return {};
  const double requirement = requirement_of(states_.table.labels[label], problem_.model);
  const std::size_t n = states_.table.columns();
  std::vector<double> received(states_.states, 0), total(n, 0);
  std::vector<bool> within(n, false);
  const bool adds = problem_.model == CommunicationModel::cooperative;
  const auto with = [&](std::size_t s, std::uint32_t j) {
    const auto signal = static_cast<double>(states_.row(label, s)[j]);
    return adds ? received[s] + signal : std::max(received[s], signal);
  };
  const auto include = [&](std::uint32_t j) {
    for (std::size_t s = 0; s < received.size(); ++s) received[s] = with(s, j);
    within[j] = true;
  };
  for (const std::uint32_t j : selected) include(j);
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::size_t s = 0; s < received.size(); ++s) total[j] += share(label, s, j);
  std::vector<std::uint32_t> order(n);
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return total[a] < total[b]; });
  for (const std::uint32_t j : order) {
    if (within[j]) continue;
    std::size_t misses = 0;
    for (std::size_t s = 0; s < received.size(); ++s) misses += is_met(with(s, j), requirement) ? 0 : 1;
    if (misses > allowed_[label]) include(j);
  }
  std::vector<double> shares(n, 0);
  for (std::uint32_t j = 0; j < n; ++j)
    if (!within[j]) shares[j] = 1;
  return shares;
}

std::size_t StateCuts::add(std::span<const std::uint32_t> selected,
                           const std::vector<std::uint32_t>& misses) {
  constexpr std::size_t at_once = 32;
  std::vector<std::uint32_t> worst;
  for (std::uint32_t i = 0; i < misses.size(); ++i)
    if (misses[i] > allowed_[i]) worst.push_back(i);
  std::stable_sort(worst.begin(), worst.end(), [&](std::uint32_t a, std::uint32_t b) {
    return misses[a] - allowed_[a] > misses[b] - allowed_[b];
  });
  if (worst.size() > at_once) worst.resize(at_once);
  const std::size_t before = size();
  for (const std::uint32_t i : worst) {
    if (const auto cut = violated_cut(i, selected); !cut.empty()) append(i, cut);
    if (const auto cut = cover_cut(i, selected); !cut.empty()) append(i, cut);
  }
  return size() - before;
}

void StateCuts::append(std::size_t label, const std::vector<double>& shares) {
  // Sums of a selection that reaches the label may fall below 1 by the tolerance of is_met and by rounding.
  constexpr double reserve = 1 + 1e-8;
  table_.labels.push_back({.id = fmt::format("{}#{}", states_.table.labels[label].id, size()),
                           .requirement = 1,
                           .single_requirement = 1});
  for (std::uint32_t j = 0; j < shares.size(); ++j)
    if (shares[j] > 0) table_.entries.push_back({j, std::min(1.0, shares[j]) * reserve});
  table_.row_begin.push_back(table_.entries.size());
}

}  // namespace shelfbeam
