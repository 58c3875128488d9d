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
  limit,        ///< a limit ended it; there may be a solution and a bound
  interrupted,  ///< cancelled; there may be a solution and a bound
  error         ///< the solver gave up or contradicted itself; nothing can be relied on
};

struct SolveOptions {
  double time_limit_s = infinity;
  /// Of the branch-and-bound tree: work, where the outcome must not depend on the machine.
  std::optional<std::uint64_t> node_limit = {};
  double relative_gap = 1e-6;
};

struct Result {
  Termination termination = Termination::error;
  double primal_bound = infinity;  ///< objective of `solution`
  double dual_bound = -infinity;   ///< no solution is better than this
  std::vector<double> solution;    ///< empty when none was found
};

/// The end of one solve; `x` and `y` are empty unless `termination` is optimal.
struct LpResult {
  Termination termination = Termination::error;
  double objective = infinity;  ///< of `x`
  std::vector<double> x;        ///< one a column
  /// The dual of every row in the order they were added: the change of the objective per unit of the row's
  /// bound, so not negative where only `lower` is finite and not positive where only `upper` is.
  std::vector<double> y;
};

/// A linear program that stays loaded: what the solver knows of one solve (its basis) is where the next one
/// starts, so that adding rows costs a few pivots of the dual simplex method. It begins
/// without rows; `Column::integer` and names are ignored.
///
/// Silent, on one thread. Costs of any magnitude are fine (all are scaled by what the first ones need); rows
/// should have coefficients of order 1. Nothing here has been verified: tolerances are the solver's, and a
/// bound that must hold is to be recomputed from `y` by who needs it.
class LpSession {
 public:
  virtual ~LpSession() = default;

  virtual void add_rows(std::span<const Row> rows) = 0;

  /// Ends early at the limit or when cancelled; the next solve goes on from there.
  virtual LpResult solve(double time_limit_s, const RunControl& control) = 0;
};

/// A MIP solver. To add one: write `solve_x`, `read_x` and `lp_x` in a .cpp of their own (the only file that
/// includes the solver's headers), declare them in backend.hpp and name them in the table in solver.cpp
/// behind the build option.
///
/// `solve` is silent, uses no more threads than `control` allows and reports incumbent and bound to
/// `control.progress`. Costs of any magnitude are fine (they are scaled inside); rows should have
/// coefficients of order 1, because solvers test them with an absolute tolerance of about 1e-7. Whatever the
/// solver says has been through `verified`. `read` reads an MPS or LP file (by its ending) with
/// the solver's own reader; throws InputError. `lp` loads columns into a linear program that stays loaded.
struct Backend {
  std::string_view name;
  std::string_view version;
  Result (*solve)(const Model&, const SolveOptions&, const RunControl&);
  Model (*read)(const std::filesystem::path&);
  std::unique_ptr<LpSession> (*lp)(std::span<const Column>);
};

/// The back ends built in, the preferred one first; never empty.
std::span<const Backend> backends();

/// The one of this name, or all where none is named. Throws InputError for a name that is not built in.
std::span<const Backend> wanted_backends(std::string_view name);

/// What a solver may be off in a bound, a row or integrality before its answer is called wrong.
inline constexpr double feasibility_tolerance = 1e-6;

/// The largest amount by which `x` misses a column bound, a whole number or a row, each relative to
/// max(1, |bound|); infinity when `x` has the wrong length or is not finite.
double violation(const Model& model, std::span<const double> x);

double objective(const Model& model, std::span<const double> x);

/// A solver's result after a check in double precision that knows no solver: integer values are rounded, the
/// objective is recomputed, and an answer that violates the model by more than `feasibility_tolerance`, or
/// claims an optimum that its own bound does not support, becomes Termination::error.
Result verified(const Model& model, const SolveOptions& options, Result result);

}  // namespace shelfbeam::milp
