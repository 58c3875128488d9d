#include "shelfbeam/placement/detail/search_problem.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/placement/export_model.hpp"

namespace shelfbeam::detail {

SearchProblem::SearchProblem(const SignalTable& t, const Question& q)
    : table(t), question(q), excludes(t.columns()), available(t.columns(), true) {
  const std::vector<double> coefficients =
      q.combination == Combination::weighted ? first_objective(t, q) : objective_coefficients(t, q);
  const double most = coefficients.empty() ? 0 : *std::max_element(coefficients.begin(), coefficients.end());
  if (most > 0) cost_unit = std::exp2(std::floor(std::log2(most)) - 39);
  for (const double coefficient : coefficients) cost.push_back(std::llround(coefficient / cost_unit));
  has_costs = std::any_of(cost.begin(), cost.end(), [](std::int64_t c) { return c != 0; });
  for (const auto& mount : t.mounts)
    for (const std::uint32_t a : mount)
      for (const std::uint32_t b : mount)
        if (a != b) excludes[a].push_back(b);
  for (std::uint32_t j = 0; j < t.columns(); ++j) {
    if (!t.transceivers[j].installed) continue;
    installed.push_back(j);
    available[j] = false;
    for (const std::uint32_t other : excludes[j]) available[other] = false;
  }
}

}  // namespace shelfbeam::detail
