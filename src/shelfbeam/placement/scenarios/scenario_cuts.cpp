#include "shelfbeam/placement/scenarios/scenario_cuts.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <string>
#include <utility>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam {

namespace {

constexpr double violated = 1 - 1e-6, violated_by_lp = 1 - 1e-3;
constexpr double missed = 1 - 2 * met_tolerance;  ///< below this, in any order of summation
constexpr std::size_t share_steps = 12;           ///< parts s that are tried for one cut
constexpr std::size_t max_labels = 256;           ///< that give cuts at once
constexpr std::size_t max_cases = 4000;           ///< of one cut
constexpr std::size_t max_sizes = 64;             ///< that are tried for one cut

// The first case of each scenario stays.
template <class Cases>
void keep_one_per_scenario(Cases& cases) {
  std::set<std::uint32_t> seen;
  std::erase_if(cases, [&](const auto& at) { return !seen.insert(at.scenario).second; });
}

}  // namespace

ScenarioCuts::ScenarioCuts(const ScenarioTable& scenarios, const PlacementProblem& problem,
                           const MissAllowance& allowance)
    : scenarios_(scenarios),
      problem_(problem),
      allowance_(allowance),
      table_(make_scenario_table(scenarios.table, {}, 0).table) {
  for (std::uint32_t i = 0; i < scenarios.table.rows(); ++i)
    if (const std::uint64_t limit = allowance.limit(i); limit < scenarios.count)
      append(cut_over(cases_of(i, {}, {}), limit, {}));
}

void ScenarioCuts::Case::add(ColumnId column, double share, bool fails) {
  received += fails ? std::min(largest, share) : share;
  if (!fails || share <= largest) return;
  largest = share;
  failed = column;
}

double ScenarioCuts::share(const Case& at, ColumnId column) const {
  if (column == at.failed) return 0;
  return detail::share_of(static_cast<double>(scenarios_.of(column, at.label)[at.scenario]),
                          requirement_of(scenarios_.table.labels[at.label], problem_.model), problem_);
}

double ScenarioCuts::Counted::of(double share) const {
  return std::min(1.0, std::max(0.0, share - above) / lack);
}

// The mean of the largest shares of a column in the cases. `shares` is a buffer.
double ScenarioCuts::mean_of_largest(std::span<const Case> cases, std::size_t kept, ColumnId column,
                                     const Counted& counted, std::vector<double>& shares) const {
  shares.resize(cases.size());
  std::transform(cases.begin(), cases.end(), shares.begin(),
                 [&](const Case& at) { return counted.of(share(at, column)); });
  const auto middle = shares.begin() + static_cast<std::ptrdiff_t>(kept);
  std::nth_element(shares.begin(), middle - 1, shares.end(), std::greater<>());
  return std::accumulate(shares.begin(), middle, 0.0) / static_cast<double>(kept);
}

ScenarioCuts::Cut ScenarioCuts::cut_over(std::span<const Case> cases, std::size_t allowed,
                                         const Counted& counted) const {
  Cut cut{.shares = std::vector<double>(scenarios_.table.columns()),
          .proof = {{cases.begin(), cases.end()}, false, counted.above, counted.units}};
  std::vector<double> shares;
  for (std::uint32_t j = 0; j < cut.shares.size(); ++j)
    cut.shares[j] = mean_of_largest(cases, cases.size() - allowed, j, counted, shares);
  return cut;
}

// The scenarios of a label, those that receive least first.
std::vector<ScenarioCuts::Case> ScenarioCuts::cases_of(LabelId label, std::span<const Part> parts,
                                                       const Counted& counted) const {
  std::vector<Case> cases;
  for (std::uint32_t s = 0; s < scenarios_.count; ++s) cases.push_back({{label, s}});
  const double requirement = requirement_of(scenarios_.table.labels[label], problem_.model);
  for (const Part& part : parts) {
    const std::span<const float> signal = scenarios_.of(part.column, label);
    for (std::size_t s = 0; s < cases.size(); ++s) {
      const double share = detail::share_of(static_cast<double>(signal[s]), requirement, problem_);
      cases[s].add(part.column, part.x * counted.of(share), problem_.redundant);
    }
  }
  std::ranges::sort(cases, {}, &Case::received);
  return cases;
}

// Takes the cut over those cases that receive least, as many as make the left side smallest.
void ScenarioCuts::lower(Cut& best, std::span<const Case> cases, std::size_t allowed,
                         std::span<const Part> parts, const Counted& counted) const {
  // The left side for t cases is at least the mean of the t - k largest signals of these.
  if (cases.size() <= allowed || cases[allowed].received >= best.left_side) return;
  std::size_t size = 0;
  std::vector<double> shares;
  const std::size_t step = std::max<std::size_t>(1, (cases.size() - allowed) / max_sizes);
  for (std::size_t t = allowed + 1; t <= cases.size(); t += step) {
    double left = 0;
    for (const Part& part : parts) {
      left += part.x * mean_of_largest(cases.first(t), t - allowed, part.column, counted, shares);
      if (left >= best.left_side) break;
    }
    if (left >= best.left_side) continue;
    best.left_side = left;
    size = t;
  }
  if (size == 0) return;
  const double left_side = best.left_side;
  best = cut_over(cases.first(size), allowed, counted);
  best.left_side = left_side;
}

// The most violated cut of a label; without shares if none is violated.
ScenarioCuts::Cut ScenarioCuts::most_violated(LabelId label, std::span<const Part> parts,
                                              std::size_t max_units) const {
  const std::uint64_t allowed = allowance_.limit(label);
  Cut best{violated_by_lp};
  if (allowed >= scenarios_.count) return best;
  const bool is_limited = max_units < scenarios_.table.columns();
  for (std::size_t k = 0; k < (is_limited ? share_steps : 1); ++k) {
    // s K grows evenly up to nearly the whole requirement.
    const double below = static_cast<double>(k) / share_steps;
    const auto units = static_cast<double>(max_units);
    const Counted counted{is_limited ? below / units : 0, missed - below, units};
    lower(best, cases_of(label, parts, counted), allowed, parts, counted);
  }
  return best;
}

std::size_t ScenarioCuts::add_violated(std::span<const double> x, std::size_t max_units,
                                       const detail::Effort& effort, const RunControl& control) {
  std::vector<Part> parts;
  for (std::uint32_t j = 0; j < x.size(); ++j)
    if (x[j] > 0) parts.push_back({j, x[j]});
  std::vector<Cut> cuts(scenarios_.table.rows());
  with_threads(control.threads, [&] {
    parallel_for_ranges(cuts.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && !effort.is_over(control); ++i)
        cuts[i] = most_violated(static_cast<std::uint32_t>(i), parts, max_units);
    });
  });
  std::erase_if(cuts, [](const Cut& cut) { return cut.shares.empty(); });
  std::ranges::stable_sort(cuts, {}, &Cut::left_side);
  cuts.resize(std::min(cuts.size(), max_labels));
  const std::size_t before = size();
  for (Cut& cut : cuts) append(std::move(cut));
  return size() - before;
}

// Extends the selection to a large set of units with which more cases, or scenarios, than allowed are missed.
ScenarioCuts::Cut ScenarioCuts::cover_cut(std::vector<Case> cases, std::size_t allowed, bool by_scenario,
                                          std::span<const Part> parts) const {
  const auto is_met = [](const Case& at) { return at.received >= missed; };
  const auto misses = [&](const std::vector<Case>& some) {
    std::set<std::uint32_t> scenarios;
    for (const Case& at : some) scenarios.insert(at.scenario);
    return by_scenario ? scenarios.size() : some.size();
  };
  std::erase_if(cases, is_met);
  if (misses(cases) <= allowed) return {};
  const std::size_t n = scenarios_.table.columns();
  std::vector<double> total(n, 0), outside(n, 1);
  for (std::uint32_t j = 0; j < n; ++j)
    for (const Case& at : cases) total[j] += share(at, j);
  for (const Part& part : parts) outside[part.column] = 0;
  for (const auto j : ordered_by<ColumnId>(n, [&](ColumnId column) { return total[column]; })) {
    if (outside[j] == 0) continue;
    std::vector<Case> still = cases;
    for (Case& at : still) at.add(j, share(at, j), problem_.redundant);
    std::erase_if(still, is_met);
    if (misses(still) <= allowed) continue;
    cases = std::move(still);
    outside[j] = 0;
  }
  if (by_scenario) keep_one_per_scenario(cases);
  cases.resize(allowed + 1);
  return {.shares = std::move(outside), .proof = {{cases.begin(), cases.end()}, true}};
}

void ScenarioCuts::add_cuts(std::vector<Case> cases, std::size_t allowed, bool by_scenario,
                            std::span<const Part> parts) {
  append(cover_cut(cases, allowed, by_scenario, parts));
  std::ranges::stable_sort(cases, {}, &Case::received);
  if (by_scenario) keep_one_per_scenario(cases);
  Cut best{violated};
  lower(best, std::span(cases).first(std::min(cases.size(), allowed + max_cases)), allowed, parts, {});
  append(std::move(best));
}

std::size_t ScenarioCuts::add(std::span<const ColumnId> selected, const ScenarioMisses& misses) {
  const std::size_t before = size();
  std::vector<Part> parts;
  for (const ColumnId j : selected) parts.push_back({j});
  auto worst = numbers_where<LabelId>(misses.of_label.size(),
                                      [&](LabelId i) { return misses.of_label[i] > allowance_.limit(i); });
  std::ranges::stable_sort(worst, std::greater{},
                           [&](LabelId i) { return misses.of_label[i] - allowance_.limit(i); });
  if (worst.size() > max_labels) worst.resize(max_labels);
  for (const LabelId i : worst) add_cuts(cases_of(i, parts, {}), allowance_.limit(i), false, parts);
  const bool too_many_scenarios = allowance_.of_shop && misses.of_shop > *allowance_.of_shop;
  const bool too_many_cases = allowance_.total && misses.total() > *allowance_.total;
  if (!too_many_scenarios && !too_many_cases) return size() - before;
  std::vector<Case> all;
  constexpr double near = 1.5;
  for (std::uint32_t i = 0; i < scenarios_.table.rows(); ++i)
    for (const Case& at : cases_of(i, parts, {}))
      if (at.received < near) all.push_back(at);
  if (too_many_scenarios) add_cuts(all, *allowance_.of_shop, true, parts);
  if (too_many_cases) add_cuts(std::move(all), *allowance_.total, false, parts);
  return size() - before;
}

// Does nothing without shares.
void ScenarioCuts::append(Cut cut) {
  // Sums of a selection that reaches the label may fall below 1 by the tolerance of is_met and by rounding.
  constexpr double reserve = 1 + 1e-8;
  for (double& share : cut.shares) share = std::min(1.0, share) * reserve;
  if (cut.shares.empty() || !proves(cut.proof, cut.shares, scenarios_, problem_, allowance_)) return;
  table_.labels.push_back({.id = std::to_string(size()), .requirement = 1, .single_requirement = 1});
  for (std::uint32_t j = 0; j < cut.shares.size(); ++j)
    if (cut.shares[j] > 0) table_.entries.push_back({j, cut.shares[j]});
  table_.row_begin.push_back(table_.entries.size());
}

}  // namespace shelfbeam
