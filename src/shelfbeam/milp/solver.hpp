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

class LpSession;

/// A MIP solver. To add one: write `solve_x`, `read_x` and `lp_x` in a .cpp of their own (the only file that
/// includes the solver's headers), declare them in backend.hpp and name them in the table in solver.cpp
/// behind the build option.
///
/// `solve` is silent, uses no more threads than `control` allows and reports incumbent and bound to
/// `control.progress`. Costs of any magnitude are fine (they are scaled inside); rows should have
/// coefficients of order 1, because solvers test them with an absolute tolerance of about 1e-7. Whatever the
/// solver says has been through `verified` (verify.hpp). `read` reads an MPS or LP file (by its ending) with
/// the solver's own reader; throws InputError. `lp` loads columns into a linear program that stays loaded
/// (lp_session.hpp).
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

}  // namespace shelfbeam::milp
