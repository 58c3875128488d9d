#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/instance.hpp"

namespace shelfbeam::detail {

/// The cooperative row of a label for solvers: entries clipped at 1 and rounded up to a grid, right-hand side
/// 1 less half a step. Every selection that reaches the label satisfies it. The row's own right-hand side is
/// ignored.
milp::Row relaxed(milp::Row row);

/// Results of earlier methods, valid for selections of cost up to the cut-off.
struct MipKnowledge {
  double cutoff = milp::infinity;      ///< only selections of at most this cost are sought
  std::vector<ColumnId> without = {};  ///< columns that are not chosen
  std::vector<milp::Row> cuts = {};    ///< further rows, over the columns of the table
};

/// A question for a CoverModel: min sum_j c_j T_j + (price of missed weight) (missed weight) over selections
/// of a number of units that miss no more weight than allowed.
struct MipGoal {
  std::span<const double> cost;  ///< c_j
  /// A feasible selection costs at most this; infinite if none is known. Units that alone cost more are
  /// omitted, so that their costs do not hide the others within the solver's tolerances.
  double known = milp::infinity;
  std::size_t min_count = 0, max_count = std::numeric_limits<std::size_t>::max();
  double price_of_misses = 0, max_missed = milp::infinity;  ///< for models with weights
};

/// The rows of a placement problem for a solver, with the cuts found so far and the effort. With weights
/// w_i, labels may be missed: a variable u_i fills the row of label i, and the missed weight is sum_i w_i
/// u_i.
class CoverModel {
 public:
  /// `weights`: one per label, or none. Instance and weights must outlive the object.
  CoverModel(const Instance& instance, const milp::SolveFunction& solve, const Effort& effort,
             const RunControl& control, const MipKnowledge& knowledge = {},
             std::span<const double> weights = {});

  /// False if a model in which labels may be missed, with all failure rows that a solution may violate, is
  /// too large to be solved to optimality.
  static bool fits_with_misses(const Instance& instance);

  struct Outcome {
    /// Ascending; the best one for the goal that the checker accepts.
    std::optional<Selection> selected;
    double bound = -milp::infinity;  ///< no selection costs less, as far as the solver's tolerances tell
    /// No feasible selection exists, or safely none of cost up to the cut-off; `selected` may cost more.
    bool infeasible = false;
    bool failed = false;  ///< the solver failed or its answer contradicts the problem
  };

  /// The selection of minimum cost. A selection that the checker rejects is cut off, and the model is solved
  /// again. The time of the effort covers all solves; its steps are the nodes of one.
  ///
  /// Bounds that are not safe are lowered by the tolerance of solvers (milp::objective_slack).
  Outcome minimise(const MipGoal& goal);

 private:
  bool may_miss() const { return !weights_.empty(); }
  bool fails_by_rows() const { return instance_.problem.redundant && instance_.is_cooperative(); }
  std::uint32_t missed(std::size_t label) const {
    return static_cast<std::uint32_t>(instance_.columns() + label);
  }
  void build();
  std::vector<milp::Row> set_goal(const MipGoal& goal, const CostBounds& bounds);
  void bound_label_rows(std::size_t max_units);
  bool add_failure_rows(const Selection& selected, const std::vector<LabelId>& unmet);
  bool add_failure(std::size_t label, std::uint32_t failed);
  void forbid_misses(std::span<const LabelId> labels);
  void cut_off(const Selection& selected, std::size_t unmet_label);

  const Instance& instance_;
  milp::SolveFunction solve_;
  RunControl control_;
  MipKnowledge knowledge_;
  std::span<const double> weights_;
  Effort effort_;
  milp::Model model_;  ///< built on first use
  bool built_ = false;
  /// Cooperative with unit failure: the pairs (label, unit) with a row in the model.
  std::set<std::pair<std::size_t, std::uint32_t>> failures_;
};

}  // namespace shelfbeam::detail
