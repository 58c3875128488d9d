#include "shelfbeam/placement/scenarios/scenario_search.hpp"

#include <algorithm>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

namespace {

constexpr std::array depths{1.0, 1.1, 1.2};  ///< in requirements

}  // namespace

double scenario_value(const ScenarioTable& scenarios, const PlacementProblem& problem,
                      std::span<const ColumnId> selected) {
  return problem.combination == Combination::spend ? price_of(scenarios.table, selected).to_spend
                                                   : static_cast<double>(selected.size());
}

double ScenarioSearch::price(ColumnId column) const {
  constexpr double least = 1e-9;
  return problem_.combination == Combination::spend
             ? std::max(least, price_to_spend(scenarios_.table.transceivers[column]))
             : 1;
}

bool ScenarioSearch::can_join(ColumnId column, const Selection& selected) const {
  const auto is_in = [&](ColumnId j) { return std::ranges::binary_search(selected, j); };
  bool fits = mounts_.available(column) && !is_in(column);
  mounts_.for_each_conflict(column, [&](std::uint32_t other) { fits = fits && !is_in(other); });
  return fits;
}

std::vector<ScenarioSearch::Weak> ScenarioSearch::weak_cases(std::span<const ColumnId> selected) const {
  std::vector<Weak> weak;
  for_each_weak(
      scenarios_, problem_, selected, depths.back(),
      [&](LabelId i, std::uint32_t s, const ReceivedSignal& received) { weak.push_back({i, s, received}); });
  return weak;
}

ScenarioSearch::Rank ScenarioSearch::rank(const std::vector<Weak>& weak, std::optional<ColumnId> added,
                                          std::span<const LabelId> labels) const {
  MissCounter misses(scenarios_.table.rows(), scenarios_.count);
  Rank rank{};
  double depth = 0;  // of the present label
  for (std::size_t k = 0; k < weak.size(); ++k) {
    const auto [label, scenario, before] = weak[k];
    const double requirement = requirement_of(scenarios_.table.labels[label], problem_.model);
    ReceivedSignal received = before;
    if (added) received.add(static_cast<double>(scenarios_.of(*added, label)[scenario]));
    for (const double level : depths) depth += is_met(received.value(), level * requirement) ? 0 : 1;
    if (!is_met(received.value(), requirement)) misses.add(label, scenario);
    if (k + 1 < weak.size() && weak[k + 1].label == label) continue;
    rank[1] += depth * depth;
    depth = 0;
  }
  rank[0] = static_cast<double>(allowance_.excess(misses.misses()));
  if (added)
    for (const LabelId i : labels)
      for (const float signal : scenarios_.of(*added, i))
        rank[2] -= std::min(
            1.0, static_cast<double>(signal) / requirement_of(scenarios_.table.labels[i], problem_.model));
  return rank;
}

Selection ScenarioSearch::with_another(Selection selected, std::span<const LabelId> labels) const {
  const std::vector<Weak> weak = weak_cases(selected);
  const Rank now = rank(weak, {}, labels);
  std::vector<Rank> gain(scenarios_.table.columns());
  with_threads(control_.threads, [&] {
    parallel_for_ranges(gain.size(), [&](std::size_t first, std::size_t last) {
      for (auto j = static_cast<std::uint32_t>(first); j < last && !effort_.is_over(control_); ++j) {
        if (!can_join(j, selected)) continue;
        const Rank then = rank(weak, j, labels);
        for (std::size_t k = 0; k < now.size(); ++k) gain[j][k] = (now[k] - then[k]) / price(j);
      }
    });
  });
  const auto best = std::ranges::max_element(gain);
  if (best == gain.end() || *best <= Rank{}) return selected;
  const ColumnId j = static_cast<std::uint32_t>(best - gain.begin());
  selected.insert(std::ranges::lower_bound(selected, j), j);
  return selected;
}

std::optional<Selection> ScenarioSearch::repaired(Selection selected, double below) const {
  for (std::size_t before = selected.size() + 1; before != selected.size() && !fits(selected);) {
    if (effort_.is_over(control_) || value(selected) >= below) return {};
    before = selected.size();
    selected = with_another(std::move(selected));
  }
  for (std::size_t k = selected.size(); k-- > 0 && !effort_.is_over(control_);) {
    if (scenarios_.table.transceivers[selected[k]].installed) continue;
    Selection fewer = selected;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    if (fits(fewer)) selected = std::move(fewer);
  }
  if (value(selected) >= below) return {};
  return selected;
}

}  // namespace shelfbeam
