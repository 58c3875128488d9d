#pragma once

#include <optional>
#include <span>
#include <vector>

#include "shelfbeam/placement/search_state.hpp"
#include "shelfbeam/placement/solver_step.hpp"
#include "shelfbeam/placement/tree_step.hpp"

namespace shelfbeam::detail {

/// The second objective of a lexicographic question: its least value among the selections of the fewest
/// units, once their number is proven.
class SecondaryObjective {
 public:
  SecondaryObjective(SearchState& state, TreeStep& trees, SolverStep& solvers);

  /// Improves the best selection without another unit, and its bound.
  void optimise();

  /// No selection of the fewest units has less; where their number is not proven, none of at least as many as
  /// are known to be needed.
  double lower_bound() const { return lower_bound_; }
  bool is_closed() const { return solver_closed_ || value_ - lower_bound_ <= equal_values * value_; }

 private:
  bool is_large() const { return !state_.is_small(); }
  bool has_tree() const { return state_.has_tree(state_.incumbent.selected().size()); }
  bool fits_mip() const {
    return !state_.solvers.only_linear && state_.table.entries.size() <= state_.limits.most_mip_entries;
  }
  void bound_by_lp(const Effort& effort);
  void search_tree(const Effort& effort);
  void ask_mip(const Effort& effort);

  void take(const std::optional<Selection>& found);
  void raise(double bound, BoundProof proof);

  static std::span<const Step<SecondaryObjective>> schedule();

  SearchState& state_;
  TreeStep& trees_;
  SolverStep& solvers_;
  std::vector<double> cost_;
  CostBounds bounds_;
  double value_, lower_bound_;
  bool solver_closed_ = false;
};

}  // namespace shelfbeam::detail
