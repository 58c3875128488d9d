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

/// The row of a label where units cooperate, as solvers get it: entries clipped at 1 and rounded up to a
/// grid, with a right-hand side of 1 that lies half a step off it. Every selection that meets the label meets
/// the row. The right-hand side that the row had is not looked at.
milp::Row relaxed(milp::Row row);

/// The rows of a question as a solver gets them, with the cuts found so far and the clock.
class CoverModel {
 public:
  CoverModel(const SignalTable& table, const Question& question, const SolveFunction& solve,
             double time_limit_s, const RunControl& control);

  struct Outcome {
    std::optional<std::vector<std::uint32_t>> selected;  ///< ascending, accepted by the checker
    double bound = -milp::infinity;                      ///< no selection costs less
    bool proven = false;                                 ///< `selected` is optimal within the solver's gap
    bool infeasible = false;  ///< no selection meets every label; only where none was known
    bool failed = false;      ///< the solver failed or contradicted what is known
  };

  /// The selection of least cost that meets every label; of exactly `count` units where that is given.
  /// Precondition: there is one that costs no more than `known`; infinite where none is known. Units that
  /// cost more alone are left out, so that their costs do not drown the others in the solver's tolerances.
  Outcome minimise(std::span<const double> cost, double known,
                   std::optional<std::size_t> count = std::nullopt);

 private:
  void build();
  void bound_label_rows(std::size_t most_units);
  bool let_fail(const std::vector<std::uint32_t>& selected, const std::vector<std::uint32_t>& unmet);
  bool add_failure(std::size_t label, std::uint32_t failed);
  void cut_off(const std::vector<std::uint32_t>& selected, std::size_t unmet_label);

  const SignalTable& table_;
  const Question& question_;
  const SolveFunction& solve_;
  const RunControl& control_;
  Deadline deadline_;
  milp::Model model_;  ///< built when it is first needed
  bool built_ = false;
  /// Redundant, cooperative: the pairs (label, unit) whose rows are in the model.
  std::set<std::pair<std::size_t, std::uint32_t>> failures_;
};

}  // namespace shelfbeam::detail
