#include "shelfbeam/plan/difference/compared_plan.hpp"

#include <utility>

#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam {

ComparedPlan compared_plan(const SignalMatrix& matrix, CertifiedPlan plan, std::string store) {
  ComparedPlan compared{matrix.labels, matrix.transceivers, {}, std::move(plan), std::move(store)};
  const Placement& placement = compared.plan.placement;
  compared.signals.reserve(matrix.rows());
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    ReceivedSignal received(placement.problem);
    for (const std::uint32_t column : placement.selected) received.add(matrix.signal(i, column));
    compared.signals.push_back(received.value());
  }
  return compared;
}

}  // namespace shelfbeam
