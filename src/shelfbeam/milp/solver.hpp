#pragma once

#include <cstdint>
#include <filesystem>
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
};

struct Result {
  Termination termination = Termination::error;
  double primal_bound = infinity;  ///< objective of `solution`
  double dual_bound = -infinity;   ///< lower bound on the objective of every solution
  std::vector<double> solution;    ///< empty if none was found
};

/// The result of one LP solve; `x` and `y` are empty unless `termination` is optimal.
struct LpResult {
  Termination termination = Termination::error;
  double objective = infinity;  ///< of `x`
  std::vector<double> x;        ///< one value per column
  /// Dual value of every row, in the order of `add_rows`: the derivative of the objective by the row's bound,
  /// so it is nonnegative if only `lower` is finite and nonpositive if only `upper` is.
  std::vector<double> y;
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

  /// Ends early at the time limit or when cancelled; the next solve continues from there.
  virtual LpResult solve(double time_limit_s, const RunControl& control) = 0;
};

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
  Result (*solve)(const Model&, const SolveOptions&, const RunControl&);
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

/// A solver's result after a check in double precision, independent of the solver: integer values are rounded
/// and the objective is recomputed. A solution that violates the model by more than `feasibility_tolerance`,
/// or an optimum that the solver's own dual bound does not support, becomes Termination::error.
Result verified(const Model& model, const SolveOptions& options, Result result);

}  // namespace shelfbeam::milp
