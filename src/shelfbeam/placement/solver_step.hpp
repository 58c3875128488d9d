#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/mip/mip.hpp"
#include "shelfbeam/placement/reduce/reduced_cover.hpp"
#include "shelfbeam/placement/search_state.hpp"

namespace shelfbeam::detail {

/// What a search asks of the solvers of linear and mixed-integer programs: each in turn, until one has an
/// answer that can be relied on.
class SolverStep {
 public:
  explicit SolverStep(SearchState& state) : state_(state) {}

  /// Raises the bound by linear programs: of the count, or of the whole sum.
  LpBound raise_bound(const Effort& effort);

  /// The LP bound of the second objective at the count of the best selection.
  LpBound bound_at_count(std::span<const double> cost, const Effort& effort) const;

  /// What reductions leave, or the whole model where they do not apply.
  void ask_mip(const Effort& effort);

  /// The least `cost` at the count of the best selection.
  ReducedAnswer ask_mip_at_count(std::span<const double> cost, const Effort& effort);

  /// Name and version of the last one; empty where none was asked.
  const std::string& asked() const { return asked_; }

 private:
  /// Within the limit of steps, where there is one.
  SolveFunction within(const milp::Backend& backend) const {
    return limited(backend.solve, state_.limits.step_limit);
  }
  template <class Ask>
  auto ask_in_turn(std::span<const milp::Backend> backends, const Ask& ask);
  ReducedAnswer ask_about_the_rest(const Effort& effort);
  ReducedAnswer ask_about_all(const Effort& effort);

  SearchState& state_;
  std::optional<DualBound> relaxation_;
  std::string asked_;
};

}  // namespace shelfbeam::detail
