#include "shelfbeam/placement/scenarios/cut_proof.hpp"

#include <algorithm>
#include <functional>
#include <numeric>
#include <set>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/label_shares.hpp"

namespace shelfbeam {

namespace {

/// The largest number of the cases that the allowance lets a selection miss; all, if no rule applies.
std::size_t max_missed(std::span<const CutProof::Case> cases, const MissAllowance& allowance) {
  std::set<std::uint32_t> labels, scenarios;
  for (const CutProof::Case& at : cases) {
    labels.insert(at.label);
    scenarios.insert(at.scenario);
  }
  std::uint64_t most = allowance.total.value_or(cases.size());
  if (labels.size() == 1) most = std::min(most, allowance.limit(*labels.begin()));
  if (allowance.of_shop && scenarios.size() == cases.size())
    most = std::min<std::uint64_t>(most, *allowance.of_shop);
  return static_cast<std::size_t>(std::min<std::uint64_t>(most, cases.size()));
}

bool are_distinct(std::span<const CutProof::Case> cases) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> seen;
  return std::ranges::all_of(
      cases, [&](const CutProof::Case& at) { return seen.emplace(at.label, at.scenario).second; });
}

}  // namespace

bool proves(const CutProof& proof, std::span<const double> shares, const ScenarioTable& scenarios,
            const PlacementProblem& problem, const MissAllowance& allowance) {
  constexpr double rounding = 1e-12;
  const std::size_t missed = max_missed(proof.cases, allowance), kept = proof.cases.size() - missed;
  if (kept == 0 || !are_distinct(proof.cases)) return false;
  const auto requirement = [&](const CutProof::Case& at) {
    return requirement_of(scenarios.table.labels.at(at.label), problem.model);
  };
  if (proof.is_cover) {
    const auto inside = numbers_where<ColumnId>(shares.size(), [&](ColumnId j) { return !(shares[j] >= 1); });
    return std::ranges::none_of(proof.cases, [&](const CutProof::Case& at) {
      ReceivedSignal received(problem);
      for (const ColumnId j : inside)
        received.add(static_cast<double>(scenarios.of(j, at.label)[at.scenario]));
      return is_met(received.value() * (1 + rounding), requirement(at));
    });
  }
  const double counted = 1 - met_tolerance - proof.above * proof.units;
  if (!(counted > 0) || !(proof.above >= 0)) return false;
  std::vector<double> parts(proof.cases.size());
  for (std::uint32_t j = 0; j < shares.size(); ++j) {
    std::ranges::transform(proof.cases, parts.begin(), [&](const CutProof::Case& at) {
      if (at.failed == j && problem.redundant) return 0.0;
      const auto signal = static_cast<double>(scenarios.of(j, at.label)[at.scenario]);
      const double share = detail::share_of(signal, requirement(at), problem);
      return std::clamp((share - proof.above) / counted, 0.0, 1.0);
    });
    const auto end = parts.begin() + static_cast<std::ptrdiff_t>(kept);
    std::ranges::nth_element(parts, end - 1, std::greater());
    if (std::accumulate(parts.begin(), end, 0.0) > static_cast<double>(kept) * shares[j] * (1 + rounding))
      return false;
  }
  return true;
}

}  // namespace shelfbeam
