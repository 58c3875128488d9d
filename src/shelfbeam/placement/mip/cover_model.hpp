#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/placement/mip/mip.hpp"

namespace shelfbeam::detail {

/// The cooperative row of a label for solvers: entries clipped at 1 and rounded up to a grid, right-hand side
/// 1 less half a step. Every selection that reaches the label satisfies it. The row's own right-hand side is
/// ignored.
milp::Row relaxed(milp::Row row);

/// The rows of a placement problem for a solver, with the cuts found so far and the deadline.
class CoverModel {
 public:
  CoverModel(const SignalTable& table, const PlacementProblem& problem, const SolveFunction& solve,
             double time_limit_s, const RunControl& control, const MipKnowledge& knowledge = {});

  struct Outcome {
    std::optional<std::vector<std::uint32_t>> selected;  ///< ascending, accepted by the checker
    double bound = -milp::infinity;  ///< no selection costs less, as far as the solver's tolerances tell
    bool proven = false;             ///< the bound supports that `selected` is optimal
    bool infeasible = false;  ///< no feasible selection exists, or safely none of cost up to the cut-off
    bool failed = false;      ///< the solver failed or contradicted what is known
  };

  /// The feasible selection of minimum cost; of exactly `count` units if given. Precondition: a feasible
  /// selection costs at most `known`; infinite if none is known. Units that alone cost more are omitted, so
  /// that their costs do not hide the others within the solver's tolerances.
  ///
  /// Bounds that are not safe are lowered by the tolerance of solvers (milp::objective_slack). `proven`
  /// requires that the bound, rounded up to CostBounds::step, is the cost of the selection, or without a
  /// step, that both differ by at most 1e-6 of the cost.
  Outcome minimise(std::span<const double> cost, double known,
                   std::optional<std::size_t> count = std::nullopt);

 private:
  void build();
  bool supports(double bound, double value, std::span<const double> cost) const;
  void bound_label_rows(std::size_t max_units);
  bool add_failure_rows(const std::vector<std::uint32_t>& selected, const std::vector<std::uint32_t>& unmet);
  bool add_failure(std::size_t label, std::uint32_t failed);
  void cut_off(const std::vector<std::uint32_t>& selected, std::size_t unmet_label);

  const SignalTable& table_;
  const PlacementProblem& problem_;
  const SolveFunction& solve_;
  const RunControl& control_;
  MipKnowledge knowledge_;
  Deadline deadline_;
  milp::Model model_;  ///< built on first use
  bool built_ = false;
  /// Cooperative with unit failure: the pairs (label, unit) with a row in the model.
  std::set<std::pair<std::size_t, std::uint32_t>> failures_;
};

}  // namespace shelfbeam::detail
