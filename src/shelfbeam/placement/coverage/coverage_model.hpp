#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::detail {

/// Max coverage as a MIP: the rows of CoverModel, with a variable u_i that fills row i if label i is missed,
///
///   min sum_j T_j + (n + 1) sum_i u_i   subject to those rows and sum_j T_j <= k.
///
/// u_i costs more than all units together, so missed labels are minimised first and units second.
class CoverageModel {
 public:
  /// False if the model is too large to be solved to optimality.
  static bool fits(const SignalTable& table, const PlacementProblem& problem) {
    std::size_t entries = table.entries.size();
    if (fails_by_rows(problem))
      for (std::size_t i = 0; i < table.rows(); ++i) entries += table.row(i).size() * table.row(i).size();
    return entries <= max_entries;
  }

  CoverageModel(const SignalTable& table, const PlacementProblem& problem, std::size_t units)
      : table_(table), problem_(problem), units_(units) {
    problem_.objective = Objective::count;
    problem_.combination = Combination::lexicographic;
    model_ = model_without_failures(table, problem_);
    // Without unit failure, u_i is binary by itself in non-cooperative rows; otherwise it is declared
    // integer.
    const bool whole = problem.redundant || problem.model == CommunicationModel::cooperative;
    const auto price = static_cast<double>(table.columns() + 1);
    for (std::size_t i = 0; i < table.rows(); ++i)
      model_.columns.push_back({price, 0, 1, whole, "missed_" + table.labels[i].id});
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const auto missed = static_cast<std::uint32_t>(table.columns() + i);
      milp::Row& row = model_.rows[i];
      if (problem.model == CommunicationModel::cooperative) row = relaxed(std::move(row));
      row.entries.push_back({missed, problem.redundant && !fails_by_rows(problem) ? 2.0 : 1.0});
      if (!fails_by_rows(problem)) continue;
      for (const SignalEntry& entry : table.row(i)) {
        model_.rows.push_back(relaxed(failure_row(table, i, entry.transceiver)));
        model_.rows.back().entries.push_back({missed, 1.0});
      }
    }
    milp::Row count{-milp::infinity, static_cast<double>(units), {}, "units"};
    for (std::uint32_t j = 0; j < table.columns(); ++j) count.entries.push_back({j, 1.0});
    model_.rows.push_back(std::move(count));
  }

  struct Outcome {
    std::optional<std::vector<std::uint32_t>> selected;  ///< without conflicts, at most `units` units
    std::size_t max_reached = 0;                         ///< no selection reaches more
    bool failed = false;  ///< the solver failed or contradicted itself; `max_reached` still holds
  };
  Outcome solve(const SolveFunction& solve, double time_limit_s, const RunControl& control) {
    const Deadline deadline(time_limit_s);
    Outcome outcome;
    outcome.max_reached = table_.rows();
    const auto price = static_cast<double>(table_.columns() + 1);
    while (!deadline.has_passed() && !control.cancelled()) {
      const milp::Result result = solve(model_, {.time_limit_s = deadline.seconds_left()}, control);
      const bool empty_handed = result.solution.empty() && !model_.columns.empty();
      const bool wrong =
          !empty_handed && milp::violation(model_, result.solution) > milp::feasibility_tolerance;
      // The model is always feasible: the installed units alone are a selection.
      if (wrong || result.termination == milp::Termination::error ||
          result.termination == milp::Termination::infeasible) {
        outcome.failed = true;
        break;
      }
      // The dual bound d of count + price missed, with count <= units < price, proves missed >= (d - units) /
      // price.
      const double missed = std::ceil((result.dual_bound - static_cast<double>(units_)) / price - 1e-6);
      if (missed > 0)
        outcome.max_reached = std::min(
            outcome.max_reached, table_.rows() - std::min(table_.rows(), static_cast<std::size_t>(missed)));
      if (empty_handed) break;
      std::vector<std::uint32_t> selected;
      for (std::uint32_t j = 0; j < table_.columns(); ++j)
        if (result.solution[j] > 0.5) selected.push_back(j);
      const Check check = check_selection(table_, problem_, selected);
      if (!check.allowed() || selected.size() > units_) {
        outcome.failed = true;
        break;
      }
      outcome.selected = selected;
      if (result.termination != milp::Termination::optimal) break;
      bool mistaken = false;
      for (const std::uint32_t i : check.unmet) {
        if (result.solution[table_.columns() + i] > 0.5) continue;
        cut_off(selected, i);
        mistaken = true;
      }
      if (!mistaken) break;
    }
    return outcome;
  }

 private:
  static constexpr std::size_t max_entries = 400'000;

  static bool fails_by_rows(const PlacementProblem& problem) {
    return problem.redundant && problem.model == CommunicationModel::cooperative;
  }

  // As CoverModel's cut: the selection misses the label, so u_i = 1 or another unit is chosen.
  void cut_off(const std::vector<std::uint32_t>& selected, std::size_t unmet_label) {
    milp::Row cut{1.0, milp::infinity, {}, "cut"};
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (!std::binary_search(selected.begin(), selected.end(), j)) cut.entries.push_back({j, 1.0});
    cut.entries.push_back({static_cast<std::uint32_t>(table_.columns() + unmet_label), 1.0});
    model_.rows.push_back(std::move(cut));
  }

  const SignalTable& table_;
  PlacementProblem problem_;
  std::size_t units_;
  milp::Model model_;
};

}  // namespace shelfbeam::detail
