#include "shelfbeam/placement/detail/search_problem.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/placement/export_model.hpp"
#include "shelfbeam/placement/mounts.hpp"

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
  const Mounts mounts(t);
  for (std::uint32_t j = 0; j < t.columns(); ++j) {
    mounts.for_each_excluded(j, [&](std::uint32_t other) { excludes[j].push_back(other); });
    available[j] = mounts.available(j) && !t.transceivers[j].installed;
    if (t.transceivers[j].installed) installed.push_back(j);
  }
}

}  // namespace shelfbeam::detail
