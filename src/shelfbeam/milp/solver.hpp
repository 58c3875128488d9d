#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/model.hpp"

namespace shelfbeam::milp {

enum class Termination {
  optimal,      ///< proven within the gap tolerance
  infeasible,   ///< proven
  limit,        ///< ended by a limit, perhaps with a solution and a bound
  interrupted,  ///< cancelled, perhaps with a solution and a bound
  error         ///< the solver failed or contradicted itself; the result is not reliable
};

struct SolveOptions {
  double time_limit_s = infinity;
  /// Work limit in nodes of the branch-and-bound tree, for results that do not depend on the machine.
  std::optional<std::uint64_t> node_limit = {};
  double relative_gap = 1e-6;
  /// Only solutions of at most this objective are sought. If there is none, the model counts as infeasible; a
  /// dual bound is at most the cut-off.
  double cutoff = infinity;
  /// Objectives of solutions are multiples of this; 0 if unknown. Only branch_and_bound uses it.
  double step = 0;
};

struct Result {
  Termination termination = Termination::error;
  double primal_bound = infinity;  ///< objective of `solution`
  double dual_bound = -infinity;   ///< lower bound on the objective of every solution
  std::vector<double> solution;    ///< empty if none was found
  bool is_safe = false;            ///< dual_bound holds without tolerances
};

/// The result of one LP solve; `x` is empty unless `termination` is optimal, and so is `y`, unless the LP is
/// infeasible or beyond the cut-off.
struct LpResult {
  Termination termination = Termination::error;
  double objective = infinity;  ///< of `x`
  std::vector<double> x;        ///< one value per column
  /// Dual value of every row, in the order of `add_rows`: the derivative of the objective by the row's bound,
  /// so it is nonnegative if only `lower` is finite and nonpositive if only `upper` is.
  std::vector<double> y;
  /// If infeasible: multipliers of the rows that show it (Farkas), as far as the solver gives them.
  std::vector<double> ray = {};
};

/// Changes of an LP's objective if a column is fixed; infinite if no solution is left.
struct Probe {
  double down = 0;  ///< at 0
  double up = 0;    ///< at 1
};

/// A linear program that stays loaded. Each solve starts from the basis of the previous one, so added rows
/// cost a few pivots of the dual simplex method. It starts without rows; `Column::integer` and names are
/// ignored.
///
/// Solves are silent and use one thread. Costs may have any magnitude (objective_scale of the columns scales
/// them); rows should have coefficients of order 1. Results are not verified and have the solver's
/// tolerances; a caller that needs a rigorous bound recomputes it from `y`.
class LpSession {
 public:
  virtual ~LpSession() = default;

  virtual void add_rows(std::span<const Row> rows) = 0;
  virtual void set_bounds(std::uint32_t column, double lower, double upper) = 0;
  /// Solves may end early, as infeasible, once the objective exceeds `objective`.
  virtual void set_cutoff(double objective) = 0;

  /// Strong branching from the last optimal solution: changes of the objective if a column in [0, 1] is fixed
  /// at 0 or 1, after at most `pivots` steps of the dual simplex method. Estimates, not bounds.
  virtual std::vector<Probe> probe(std::span<const std::uint32_t> columns, int pivots) = 0;

  /// Ends early at the time limit or when cancelled; the next solve continues from there.
  virtual LpResult solve(double time_limit_s, const RunControl& control) = 0;
};

/// Solves a model: that of a back end, or a function in its place, as in tests.
using SolveFunction = std::function<Result(const Model&, const SolveOptions&, const RunControl&)>;

/// A MIP solver. To add a solver, write `solve_x`, `read_x` and `lp_x` in a new .cpp (the only file that
/// includes the solver's headers), declare them in backend.hpp and add them to the table in solver.cpp behind
/// a build option.
///
/// `solve` is silent, uses no more threads than `control` allows and reports incumbent and bound to
/// `control.progress`. Costs may have any magnitude (they are scaled internally); rows should have
/// coefficients of order 1, because solvers test them with an absolute tolerance of about 1e-7. Every result
/// has passed `verified`. `read` reads an MPS or LP file (by its extension) with the solver's own reader;
/// throws InputError. `lp` starts an LpSession with these columns.
struct Backend {
  std::string_view name;
  std::string_view version;
  /// "highs 1.10.0"
  std::string full_name() const;
  SolveFunction solve;
  Model (*read)(const std::filesystem::path&);
  std::unique_ptr<LpSession> (*lp)(std::span<const Column>);
};

/// The back ends of this build, the preferred one first; never empty.
std::span<const Backend> backends();

/// The back end of this name, or all back ends for an empty name. Throws InputError for an unknown name.
std::span<const Backend> backends_of(std::string_view name);

/// Max `violation` of a column bound, a row or integrality in an accepted solution.
inline constexpr double feasibility_tolerance = 1e-6;

/// The largest violation of a column bound or a row by `x`, relative to max(1, |bound|), or of integrality;
/// infinity if `x` has the wrong length or is not finite.
double violation(const Model& model, std::span<const double> x);

double objective(const Model& model, std::span<const double> x);

/// Relative accuracy of objectives and dual bounds. Solvers accept values that are integral within 1e-7.
inline constexpr double objective_tolerance = 2e-7;

/// Tolerance for objectives and dual bounds of this model, relative to the largest cost or the value.
double objective_slack(const Model& model, double objective_value);

/// A solver's result after a check in double precision, independent of the solver: integer values are rounded
/// and the objective is recomputed. A solution that violates the model by more than `feasibility_tolerance`,
/// or an optimum that the solver's own dual bound does not support, becomes Termination::error.
Result verified(const Model& model, const SolveOptions& options, Result result);

}  // namespace shelfbeam::milp
