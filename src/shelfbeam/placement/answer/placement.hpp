#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/method.hpp"
#include "shelfbeam/placement/answer/partial_reach.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"
#include "shelfbeam/placement/problem/spend.hpp"

namespace shelfbeam {

enum class Status {
  optimal,     ///< proven optimal
  feasible,    ///< every label is reached; no claim of optimality (greedy)
  infeasible,  ///< proven infeasible: see `unreachable`
  /// A limit, an interruption or a solver failure came first, or no first selection was found: the incumbent,
  /// if any, and the bound.
  stopped
};

/// The proof of a lower bound.
enum class BoundProof {
  trivial,   ///< no search: installed units, one more if they miss a label, costs of the cheapest units
  dual,      ///< multipliers, summed again from the table, independent of the solver that found them
  log,       ///< log of a tree search or an enumeration, verified step by step from the table
  branches,  ///< branch and bound; the bound of every node was summed again from multipliers
  search,    ///< exhaustive search whose log was not verified, because it was too long or for another reason
  solver     ///< MIP solver, not verified independently
};

struct Unreachable {
  LabelId label;
  double requirement = 0;
  double max_signal = 0;  ///< Mounts::max_signal
};

/// The result of `place`. Indices refer to the table; `selected` is ascending and contains every installed
/// unit. An infeasible problem has no selection and infinite values. A stopped result without a selection has
/// an infinite objective_value.
struct Placement {
  PlacementProblem problem;
  Status status = Status::stopped;
  Selection selected;
  double count_lower_bound = 0;  ///< proven: every feasible selection has at least this many units
  /// Count; second objective (lexicographic); whole sum (weighted); or new spend (spend).
  double objective_value = 0;
  /// Proven lower bound on objective_value. Lexicographic: on the second objective among selections of the
  /// minimum count; before that count is proven, the cost of the cheapest count_lower_bound units.
  double lower_bound = 0;
  BoundProof bound_proof = BoundProof::trivial;  ///< of lower_bound and of count_lower_bound
  /// Tie rule: among all selections T of this value (within 1e-12 of it), `selected` has the largest minimum
  /// margin, max_T min_i S_i / (gamma_i tau_i), then the fewest units, then the ids that come first in order.
  bool ties_settled = false;
  std::optional<Price> price = {};  ///< of `selected`; nothing if the table has no prices (has_prices)
  bool unit_costs = false;          ///< no costs were given for the objective, so each link or signal costs 1
  double min_spacing = 0;           ///< m; SignalTable::min_spacing
  std::size_t forbidden_pairs = 0;  ///< number of SignalTable::conflicts
  /// For a question that does not require all labels. There is then no bound on costs, and `infeasible` means
  /// that no selection reaches the required share.
  std::optional<PartialReach> partial = {};
  /// Labels that no selection reaches. An infeasible problem without any has conflicts that prevent one
  /// selection from reaching all labels.
  std::vector<Unreachable> unreachable;
  SolvedBy solver = {};
  std::vector<SearchStep> steps = {};  ///< of the search; not part of the placement file
  double seconds = 0;                  ///< wall time

  std::size_t count() const { return selected.size(); }
  /// A selection exists; it is empty if there are no labels and no installed units.
  bool has_selection() const { return objective_value < std::numeric_limits<double>::infinity(); }
  /// (objective_value - lower_bound) / objective_value; 0 when proven, infinite without a selection.
  double gap() const;
};

/// No selection is feasible.
Placement infeasible_placement(std::vector<Unreachable> unreachable = {});

enum class SolverChoice {
  automatic,  ///< the whole schedule, with a MIP back end for the cases that suit it
  search,     ///< no MIP: selection and proof depend on no solver (LP bounds are summed again)
  mip,        ///< a MIP back end alone
  greedy      ///< the paper's greedy method, with bounds that need no search
};

struct PlaceOptions {
  SolverChoice solver = SolverChoice::automatic;
  std::string backend = {};  ///< MIP back end by name; empty: the preferred one, then the next if it fails
  double time_limit_s = 60;
  /// Replaces the time limit: each stage of the search ends after this many steps (moves of a local search,
  /// nodes of a tree or of a MIP). With one thread the result is then the same on every machine.
  std::optional<std::uint64_t> step_limit = {};
  /// Seed of the local search, the only user of random numbers. Proven values do not depend on it.
  std::uint64_t seed = 1;
  /// Ascending, with every installed unit. Every search begins with it if it answers the question better than
  /// the greedy selection.
  Selection start = {};
  bool proves = true;        ///< false: a short local search, without proof
  bool settles_ties = true;  ///< false: any selection of the best value is accepted

  /// The search may use this method.
  bool uses(SolverChoice choice) const { return solver == SolverChoice::automatic || solver == choice; }
};

/// Solves the placement problem for a table. Every returned selection has passed the checker (checker.hpp).
/// Costs must be finite and not negative. Throws InputError if a label has no requirement or the back end is
/// unknown.
Placement place(const SignalTable& table, const PlacementProblem& problem, const PlaceOptions& options,
                const RunControl& control = {});

}  // namespace shelfbeam
