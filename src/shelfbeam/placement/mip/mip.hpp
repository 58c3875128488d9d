#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam {

/// milp::Backend::solve or a substitute for tests.
using SolveFunction =
    std::function<milp::Result(const milp::Model&, const milp::SolveOptions&, const RunControl&)>;

struct MipResult {
  Placement placement;         ///< without `problem`, `unit_costs`, `solver` and `seconds`
  bool solver_failed = false;  ///< the solver's results were inconsistent; bounds and selection still hold
};

/// Results of earlier methods, valid for selections of cost up to the cut-off.
struct MipKnowledge {
  double cutoff = milp::infinity;      ///< only selections of at most this cost are sought
  std::vector<ColumnId> without = {};  ///< columns that are not chosen
  std::vector<milp::Row> cuts = {};    ///< further rows, over the columns of the table
};

/// Solves a placement problem with a MIP solver, starting from `start`, a selection that the checker accepts.
/// Without a start, conflicts may make the problem infeasible, or it may stop without a selection and with an
/// infinite value.
///
/// Rows are those of placement_model with a_ij = min(1, M_ij / (gamma_i tau_i)), rounded up to multiples of
/// 2^-20 if cooperative. A selection that the checker rejects is cut off, and the model is solved again. The
/// time covers everything; the steps are nodes of one solve. Without time `solve` may be empty, and the
/// result is `start` with the bounds that need no search. With a cut-off in `knowledge` and without a start,
/// `infeasible` means a safe proof that no selection costs at most the cut-off.
MipResult place_by_mip(const detail::Instance& instance, const std::optional<Selection>& start,
                       const SolveFunction& solve, const detail::Effort& effort, const RunControl& control,
                       const MipKnowledge& knowledge = {});

}  // namespace shelfbeam
