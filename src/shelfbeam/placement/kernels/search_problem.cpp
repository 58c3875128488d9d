#include "shelfbeam/placement/kernels/search_problem.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/mounts.hpp"

namespace shelfbeam::detail {

SearchProblem::SearchProblem(const SignalTable& t, const Question& q)
    : table(t), question(q), excludes(t.columns()), available(t.columns(), true) {
  const std::vector<double> coefficients =
      q.combination == Combination::weighted ? first_objective(t, q) : objective_coefficients(t, q);
  const double most = coefficients.empty() ? 0 : *std::max_element(coefficients.begin(), coefficients.end());
  constexpr double bits = 60;  // of what all columns cost together
  if (most > 0)
    cost_unit = std::exp2(std::ceil(std::log2(most) + std::log2(static_cast<double>(t.columns()))) - bits);
  for (const double coefficient : coefficients) cost.push_back(std::llround(coefficient / cost_unit));
  has_costs = std::any_of(cost.begin(), cost.end(), [](std::int64_t c) { return c != 0; });
  std::vector<std::uint32_t> by_id(t.columns());
  std::iota(by_id.begin(), by_id.end(), 0U);
  std::stable_sort(by_id.begin(), by_id.end(), [&](std::uint32_t a, std::uint32_t b) {
    return t.transceivers[a].id < t.transceivers[b].id;
  });
  place_by_id.resize(t.columns());
  for (std::uint32_t k = 0; k < by_id.size(); ++k) place_by_id[by_id[k]] = k;
  const Mounts mounts(t);
  for (std::uint32_t j = 0; j < t.columns(); ++j) {
    mounts.for_each_excluded(j, [&](std::uint32_t other) { excludes[j].push_back(other); });
    available[j] = mounts.available(j) && !t.transceivers[j].installed;
    if (t.transceivers[j].installed) installed.push_back(j);
  }
}

bool SearchProblem::is_first_by_id(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) const {
  const auto places = [&](std::span<const std::uint32_t> selected) {
    std::vector<std::uint32_t> result;
    for (const std::uint32_t j : selected) result.push_back(place_by_id[j]);
    std::sort(result.begin(), result.end());
    return result;
  };
  return places(a) < places(b);
}

}  // namespace shelfbeam::detail
