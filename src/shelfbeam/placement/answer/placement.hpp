#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

enum class Status {
  optimal,     ///< proven
  feasible,    ///< every label is met; nothing is claimed about the rest (greedy)
  infeasible,  ///< proven: see `unreachable`
  /// A limit or an interruption came first, the solver failed, or no way was found to begin with: best
  /// selection, if there is any, and bound so far.
  stopped
};

/// What stands behind a lower bound.
enum class BoundProof {
  trivial,  ///< installed units, one more where a label is unmet, the cheapest of so many
  dual,     ///< multipliers of rows, added up again from the table without the solver that found them
  log,      ///< the log of an exhaustive search, checked step by step from the table without the search
  search,   ///< an exhaustive search whose log was too long to be checked
  solver    ///< the word of a MIP solver
};

struct Unreachable {
  std::uint32_t label = 0;
  double requirement = 0;
  double most = 0;  ///< Mounts::most_signal
};

/// An answer. Indices refer to the table it was computed from; `selected` is in ascending order and holds
/// every installed unit. An infeasible question has no selection and infinite values; a stopped one for which
/// none was found has no selection and an infinite objective_value.
struct Placement {
  Question question;
  Status status = Status::stopped;
  std::vector<std::uint32_t> selected;
  double count_lower_bound = 0;  ///< proven: no selection that meets every label has fewer units
  double objective_value = 0;    ///< count; the second objective (lexicographic); or the whole sum (weighted)
  /// Proven, of objective_value. Lexicographic: of the second objective among the selections with the fewest
  /// units; while their number is not proven, the cheapest count_lower_bound units.
  double lower_bound = 0;
  BoundProof bound_proof = BoundProof::trivial;  ///< of lower_bound, and of count_lower_bound
  /// Of all placements with this value (up to 1e-12 of it) this has the largest smallest margin, of these the
  /// fewest units, and its ids, in order, come first among those: the same for any number of threads.
  bool ties_settled = false;
  bool unit_costs = false;          ///< no cost was given for the objective, so each link or signal counted 1
  double min_spacing = 0;           ///< m; SignalTable::min_spacing
  std::size_t forbidden_pairs = 0;  ///< candidates that must not be chosen together: SignalTable::apart
  /// Labels that no selection meets. Infeasible without any: each could be met, but not all by one selection,
  /// because candidates exclude one another (Mounts).
  std::vector<Unreachable> unreachable;
  /// "search", "search with highs 1.10.0" (the back end that solved its linear programs or a MIP), "greedy",
  /// name and version of the MIP back end, or empty: labels are unreachable, which needs no solver.
  std::string solver;
  double seconds = 0;  ///< wall time

  std::size_t count() const { return selected.size(); }
  /// There is a selection; it may be that of no units, where there are no labels.
  bool has_selection() const { return objective_value < std::numeric_limits<double>::infinity(); }
  /// (incumbent - bound) / incumbent of the objective value; 0 when proven, infinite without a selection.
  double gap() const;
};

enum class SolverChoice {
  automatic,  ///< the search, which leaves to a MIP back end what that is better at
  search,  ///< the search alone: a back end solves its linear programs, whose bounds are added up again, but
           ///< no part of the answer or of its proof is a MIP solver's
  mip,     ///< a MIP back end alone
  greedy   ///< the paper's heuristic, with bounds that need no search
};

struct PlaceOptions {
  SolverChoice solver = SolverChoice::automatic;
  std::string backend = {};  ///< MIP back end by name; empty: the preferred one, the next where it fails
  double time_limit_s = 60;
  /// Instead of the time: each part of the search ends after so many steps, which are moves of a local
  /// search, nodes of a tree or of a MIP. With one thread the answer is the same on every machine, busy or
  /// not.
  std::optional<std::uint64_t> step_limit = {};
  /// Of the local search, which alone draws random numbers; no proven value depends on it.
  std::uint64_t seed = 1;
  bool settles_ties = true;  ///< false: any placement of the best value will do
};

/// Answers the question for a table. Every returned selection has passed the checker (checker.hpp). Costs
/// must be finite and not negative. Throws InputError when a label has no requirement or the back end is
/// unknown.
Placement place(const SignalTable& table, const Question& question, const PlaceOptions& options,
                const RunControl& control = {});

}  // namespace shelfbeam
