#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/answer/incumbent.hpp"
#include "shelfbeam/placement/answer/search_step.hpp"
#include "shelfbeam/placement/bound/count_bound.hpp"
#include "shelfbeam/placement/kernels/walks.hpp"
#include "shelfbeam/placement/placement_search.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"
#include "shelfbeam/placement/tree/tree_search.hpp"

namespace shelfbeam::detail {

/// State shared by the steps of one search: problem, incumbent, bounds and remaining time. Reports incumbent
/// and bound as progress, whichever method runs.
struct SearchState final : ProgressSink {
  SearchState(const Instance& instance, const std::optional<Selection>& start,
              std::span<const milp::Backend> backends, const PlaceOptions& options, const Deadline& deadline,
              const RunControl& control, const SearchLimits& limits);
  SearchState(const SearchState&) = delete;

  const Instance& instance;
  std::span<const milp::Backend> backends;
  const PlaceOptions& options;
  const SearchLimits& limits;
  Deadline deadline;
  bool searches;  ///< our own methods run; otherwise a MIP back end alone, or none
  std::uint32_t seed;
  std::optional<SearchMatrix> matrix;  ///< all rows, for a search within the memory limit
  std::optional<TreeSearch> tree;      ///< starts with the rows and weights of the last LP
  Incumbent incumbent;                 ///< by the first objective
  /// The incumbent by the second objective, once the first is done. Its bound holds at the minimum count; if
  /// that is not proven, over all counts from its lower bound on.
  std::optional<Incumbent> second;
  /// Reduced-cost fixing, ascending: if a selection of cost CostBounds::below(value) exists, an optimal one
  /// contains none of these columns and is among those of `open_selections`.
  std::vector<ColumnId> useless;
  std::optional<DualBound> relaxation;  ///< the last LP of the first objective, for `open_selections`
  /// Label rows and multipliers of the last relaxation of the first objective, for the next one.
  std::vector<BoundRow> rows;
  std::optional<std::string> last_backend;  ///< name and version of the last back end used
  ProgressSink* watcher;
  RunControl control;     ///< reports through this object
  std::string_view step;  ///< name of the current step
  std::vector<SearchStep> steps;

  Effort whole() const { return {options.step_limit.value_or(any_steps), deadline.end()}; }
  bool is_settled() const { return incumbent.is_closed() && (!second || second->is_closed()); }
  bool ends() const { return is_settled() || out_of_time(); }
  double value() const { return second ? second->value() : incumbent.value(); }
  double bound() const { return second ? second->bound() : incumbent.bound(); }
  void after(const Effort&) const {}  ///< reports come with each change
  bool out_of_time() const { return control.cancelled() || deadline.has_passed(); }

  /// A tree search may end within seconds.
  bool is_small() const {
    return incumbent.selected().size() <= limits.small_answer &&
           instance.table.entries.size() <= limits.max_mip_entries;
  }
  bool fits_mip() const {
    return options.uses(SolverChoice::mip) && instance.table.entries.size() <= limits.max_mip_entries;
  }
  bool may_ask_mip() const { return fits_mip() || (options.uses(SolverChoice::mip) && instance.is_cover()); }
  /// No selection better than the incumbent has more units.
  std::size_t max_better_count() const {
    const double below = instance.bounds.below(incumbent.value());
    return instance.is_weighted() ? instance.bounds.affordable(below) : incumbent.selected().size() - 1;
  }
  /// A tree search is suitable for selections of `units` units.
  bool has_tree(std::size_t units) const {
    return matrix && instance.rows() * instance.columns() <= limits.max_cells_of_trees &&
           units <= limits.max_units_of_trees;
  }

  void offer(const std::optional<Selection>& found) {
    if (found && incumbent.offer(*found, instance.value_of(*found))) report_state();
  }
  void raise(double bound, BoundProof proof) {
    if (incumbent.raise(bound, proof, step)) report_state();
  }
  /// A bound that holds for `open_selections`.
  void raise_open(double bound, BoundProof proof) {
    const double value = incumbent.value(), below = instance.bounds.below(value);
    raise(bound > below ? (instance.bounds.sees_steps(value) ? value : std::max(below, incumbent.bound()))
                        : bound,
          proof);
  }
  /// Excludes the columns that this bound rules out, or these; true if enough of them are new for a
  /// reduction.
  bool exclude(const DualBound& dual);
  bool exclude(std::span<const ColumnId> columns);
  /// The selections that remain after reductions and exclusions.
  SelectionSet open_selections();
  /// The same for the second objective.
  void offer_second(const std::optional<Selection>& found);
  void raise_second(double bound, BoundProof proof);

  /// The remainder of the reductions without useless columns, computed on first use. Covers only.
  const Reduction& reduction();
  /// The remainder for selections of cost up to `cost`, by the reduced costs of `relaxation`.
  Reduction reduction_below(double cost) const;

  void report_state() const { control.report(Task::placing, -1); }
  void report(Task stage, double fraction, std::string_view detail) override;

 private:
  Reduction reduction_without(std::span<const ColumnId> columns) const;

  std::optional<Reduction> reduction_;
  std::size_t reduced_without_ = 0;  ///< number of useless columns at the time
  Selection reported_;
};

/// The back ends of a search with CBC, whose linear programs Clp solves, in front.
std::vector<milp::Backend> clp_first(const SearchState& state);

// The steps of a search. Each raises a bound or offers a selection, or both.

/// Tree search. Weighted: for a cheaper selection. Otherwise from the bound upwards: a selection whose count
/// equals the bound is optimal; if none exists, the bound rises by one.
void raise_bound_by_tree(SearchState& state, const Effort& effort);

/// Lagrangian bound on the count or the whole sum by dual ascent and subgradient steps, without a solver.
/// Excludes columns by their reduced costs.
void raise_bound_by_multipliers(SearchState& state, const Effort& effort);

/// LP bound on the count or the whole sum, with the next back end if one fails. The LP's rows and dual
/// solution become the first rows and weights of the tree search.
void raise_bound_by_lp(SearchState& state, const Effort& effort);

/// Branch and bound by linear programs on the remainder of the reductions, for a selection better than the
/// incumbent.
void branch_on_remainder(SearchState& state, const Effort& effort);

/// Bound from windows of neighbouring labels, each searched exactly, on the remainder of the reductions.
/// Offers the selections that the windows make together.
void raise_bound_by_windows(SearchState& state, const Effort& effort);

/// The same for sums of signals that are counted, each window a MIP.
void raise_bound_by_window_mips(SearchState& state, const Effort& effort);

/// MIP on the remainder of the reductions, or on the whole model if they do not apply, for a selection better
/// than the incumbent, without useless columns.
void solve_mip(SearchState& state, const Effort& effort);

/// MIP on the whole model. It knows only the value of the incumbent.
void solve_mip_alone(SearchState& state, const Effort& effort);

// The same methods for the second objective, among selections of at most as many units as the incumbent.
void bound_second_by_multipliers(SearchState& state, const Effort& effort);
void bound_second_by_lp(SearchState& state, const Effort& effort);
void search_second_by_tree(SearchState& state, const Effort& effort);
void solve_mip_for_second(SearchState& state, const Effort& effort);

/// Settles ties: among selections that cost no more than the incumbent, finds the one with the largest
/// minimum margin,
///
///   max_T min_i S_i / (gamma_i tau_i),
///
/// then the fewest units, then the ids that come first in order. Starts with `start` if it is one of them, is
/// limited by work, and uses nothing that depends on timing, so the result is the same for any number of
/// threads. True if all ties were examined. Margins are those of `problem`, which has the feasible selections
/// and costs of the search's problem.
bool settle_ties(SearchState& state, const PlacementProblem& problem, const Selection& start);

}  // namespace shelfbeam::detail
