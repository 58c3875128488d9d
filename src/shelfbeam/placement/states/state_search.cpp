#include "shelfbeam/placement/states/state_search.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace shelfbeam {

namespace {

using Selection = StateSearch::Selection;

constexpr std::array depths{1.0, 1.1, 1.2};  ///< in requirements

Selection with(Selection selected, std::uint32_t j) {
  selected.insert(std::lower_bound(selected.begin(), selected.end(), j), j);
  return selected;
}

Selection without(Selection selected, std::uint32_t j) {
  selected.erase(std::lower_bound(selected.begin(), selected.end(), j));
  return selected;
}

}  // namespace

double state_value(const StateTable& states, const PlacementProblem& problem,
                   std::span<const std::uint32_t> selected) {
  if (problem.combination != Combination::spend) return static_cast<double>(selected.size());
  double spend = 0;
  for (const std::uint32_t j : selected) spend += price_to_spend(states.table.transceivers[j]);
  return spend;
}

double StateSearch::price(std::uint32_t column) const {
  constexpr double least = 1e-9;
  return problem_.combination == Combination::spend
             ? std::max(least, price_to_spend(states_.table.transceivers[column]))
             : 1;
}

bool StateSearch::can_join(std::uint32_t column, const Selection& selected) const {
  if (!mounts_.available(column) || std::binary_search(selected.begin(), selected.end(), column))
    return false;
  bool fits = true;
  mounts_.for_each_conflict(column, [&](std::uint32_t other) {
    if (std::binary_search(selected.begin(), selected.end(), other)) fits = false;
  });
  return fits;
}

std::vector<StateSearch::Weak> StateSearch::weak_labels(std::span<const std::uint32_t> selected) const {
  std::vector<Weak> result;
  std::vector<ReceivedSignal> received;
  for (std::uint32_t i = 0; i < states_.table.rows(); ++i) {
    const double enough = depths.back() * requirement_of(states_.table.labels[i], problem_.model);
    received.assign(states_.states, ReceivedSignal(problem_));
    for (const std::uint32_t j : selected) {
      const std::span<const float> signal = states_.of(j, i);
      for (std::size_t s = 0; s < signal.size(); ++s) received[s].add(static_cast<double>(signal[s]));
    }
    Weak weak{i, {}, {}};
    for (std::uint32_t s = 0; s < received.size(); ++s)
      if (!is_met(received[s].value(), enough)) {
        weak.states.push_back(s);
        weak.received.push_back(received[s]);
      }
    if (!weak.states.empty()) result.push_back(std::move(weak));
  }
  return result;
}

StateSearch::Rank StateSearch::rank(const std::vector<Weak>& weak, std::optional<std::uint32_t> added) const {
  StateMisses misses;
  misses.of_label.assign(states_.table.rows(), 0);
  std::vector<bool> any(allowance_.of_shop ? states_.states : 0, false);
  Rank rank;
  for (const Weak& label : weak) {
    const double requirement = requirement_of(states_.table.labels[label.label], problem_.model);
    std::uint64_t depth = 0;
    for (std::size_t k = 0; k < label.states.size(); ++k) {
      ReceivedSignal received = label.received[k];
      if (added) received.add(static_cast<double>(states_.of(*added, label.label)[label.states[k]]));
      for (const double level : depths) depth += is_met(received.value(), level * requirement) ? 0 : 1;
      if (is_met(received.value(), requirement)) continue;
      ++misses.of_label[label.label];
      if (!any.empty()) any[label.states[k]] = true;
    }
    rank.depth += static_cast<double>(depth * depth);
  }
  misses.of_shop = static_cast<std::uint32_t>(std::count(any.begin(), any.end(), true));
  rank.excess = allowance_.excess(misses);
  return rank;
}

Selection StateSearch::with_another(Selection selected) const {
  const std::vector<Weak> weak = weak_labels(selected);
  const Rank now = rank(weak, {});
  std::optional<std::uint32_t> best_unit;
  std::pair<double, double> best{};
  for (std::uint32_t j = 0; j < states_.table.columns() && !is_over_(); ++j) {
    if (!can_join(j, selected)) continue;
    const Rank then = rank(weak, j);
    const std::pair gain{(static_cast<double>(now.excess) - static_cast<double>(then.excess)) / price(j),
                         (now.depth - then.depth) / price(j)};
    if (gain <= best) continue;
    best_unit = j;
    best = gain;
  }
  return best_unit ? with(std::move(selected), *best_unit) : selected;
}

Selection StateSearch::with_strongest(Selection selected, std::span<const std::uint32_t> labels) const {
  std::optional<std::uint32_t> best_unit;
  double best = 0;
  for (std::uint32_t j = 0; j < states_.table.columns(); ++j) {
    if (!can_join(j, selected)) continue;
    double sum = 0;
    for (const std::uint32_t i : labels)
      for (const float signal : states_.of(j, i))
        sum += std::min(
            1.0, static_cast<double>(signal) / requirement_of(states_.table.labels[i], problem_.model));
    if (sum <= best * price(j)) continue;
    best_unit = j;
    best = sum / price(j);
  }
  return best_unit ? with(std::move(selected), *best_unit) : selected;
}

std::optional<Selection> StateSearch::repaired(Selection selected, double below) const {
  while (!fits(misses_of(states_, problem_, selected))) {
    if (is_over_() || value(selected) >= below) return {};
    Selection more = with_another(selected);
    if (more == selected) return {};
    selected = std::move(more);
  }
  for (std::size_t k = selected.size(); k-- > 0;) {
    if (is_installed(selected[k])) continue;
    Selection fewer = without(selected, selected[k]);
    if (fits(misses_of(states_, problem_, fewer))) selected = std::move(fewer);
  }
  if (value(selected) >= below) return {};
  return selected;
}

Selection StateSearch::spread(Selection selected) const {
  const double most = value(selected);
  Rank now = rank_of(selected);
  for (bool improves = true; improves && !is_over_();) {
    improves = false;
    for (const std::uint32_t out : Selection(selected)) {
      if (is_installed(out) || is_over_()) continue;
      const Selection rest = without(selected, out);
      const std::vector<Weak> weak = weak_labels(rest);
      std::optional<std::uint32_t> best;
      for (std::uint32_t in = 0; in < states_.table.columns() && !is_over_(); ++in) {
        if (in == out || !can_join(in, rest) || value(with(rest, in)) > most) continue;
        const Rank then = rank(weak, in);
        if (!(then < now)) continue;
        now = then;
        best = in;
      }
      if (!best) continue;
      selected = with(rest, *best);
      improves = true;
    }
  }
  return selected;
}

}  // namespace shelfbeam
