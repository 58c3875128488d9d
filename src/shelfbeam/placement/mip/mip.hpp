#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

namespace shelfbeam {

/// milp::Backend::solve, or what a test puts in its place.
using SolveFunction =
    std::function<milp::Result(const milp::Model&, const milp::SolveOptions&, const RunControl&)>;

/// The same solver with a limit of its nodes, where there is one.
SolveFunction limited(const SolveFunction& solve, std::optional<std::uint64_t> nodes);

struct MipAnswer {
  Placement placement;  ///< all but `solver` and `seconds`
  bool solver_failed =
      false;  ///< the solver's answers could not be relied on; bounds and selection still can
};

/// Answers a question with a MIP solver, starting from `start`, a selection that the checker accepts. Where
/// none is known the answer may be that there is none (candidates exclude one another), or,
/// stopped, have no selection and an infinite value.
///
/// Rows are those of placement_model with a_ij = min(1, M_ij / (gamma_i tau_i)), rounded up to multiples of
/// 2^-20 where units cooperate. A selection that the checker rejects is cut off and the model solved again.
/// The time limit covers everything; without any time, `solve` may be empty, and the answer is `start` with
/// the bounds that need no search.
MipAnswer place_by_mip(const SignalTable& table, const Question& question,
                       const std::optional<std::vector<std::uint32_t>>& start, const SolveFunction& solve,
                       double time_limit_s, const RunControl& control);

}  // namespace shelfbeam
