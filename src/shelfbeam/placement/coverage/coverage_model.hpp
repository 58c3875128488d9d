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
#include "shelfbeam/placement/coverage/label_weights.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam::detail {

/// Max coverage as a MIP: the rows of CoverModel, with a variable u_i that fills row i if label i is missed.
///
///   maximise:  min sum_j T_j + (n + 1) sum_i w_i u_i   subject to those rows and sum_j T_j <= k,
///   minimise:  min sum_j T_j   subject to those rows and sum_i w_i u_i <= total weight - target.
///
/// In the first, u_i costs more than all units together if weights are whole, so the missed weight is
/// minimised first and units second. Units cost nothing if they are not.
class CoverageModel {
 public:
  /// False if the model is too large to be solved to optimality.
  static bool fits(const SignalTable& table, const PlacementProblem& problem) {
    std::size_t entries = table.entries.size();
    if (fails_by_rows(problem))
      for (std::size_t i = 0; i < table.rows(); ++i) entries += table.row(i).size() * table.row(i).size();
    return entries <= max_entries;
  }

  CoverageModel(const SignalTable& table, const PlacementProblem& problem, const LabelWeights& weights)
      : table_(table), problem_(problem), weights_(weights) {
    problem_.objective = Objective::count;
    problem_.combination = Combination::lexicographic;
    model_ = model_without_failures(table, problem_);
    // In non-cooperative rows without unit failure, u_i need not be declared integer.
    const bool whole = problem.redundant || problem.model == CommunicationModel::cooperative;
    for (std::size_t i = 0; i < table.rows(); ++i)
      model_.columns.push_back({0, 0, 1, whole, "missed_" + table.labels[i].id});
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
  }

  struct Outcome {
    std::optional<std::vector<std::uint32_t>> selected = {};  ///< without conflicts, within that row
    /// maximise: no selection reaches more weight. minimise: every selection has at least as many units.
    double bound = 0;
    bool is_infeasible = false;  ///< according to the solver, no selection satisfies that row; never if known
    bool failed = false;         ///< the solver failed or contradicted itself; `bound` still holds
  };

  /// The maximum weight that at most `units` units reach. Only selections better than a known one are sought,
  /// of more than `known_weight`, or with fewer than `known_units` units.
  Outcome maximise(std::size_t units, double known_weight, std::size_t known_units,
                   const SolveFunction& solve, double time_limit_s, const RunControl& control) {
    const double unit_price = weights_.are_whole() ? 1 : 0;
    const double price = weights_.are_whole() ? static_cast<double>(table_.columns() + 1) : 1;
    milp::Row count{-milp::infinity, static_cast<double>(units), {}, "units"};
    for (std::uint32_t j = 0; j < table_.columns(); ++j) {
      model_.columns[j].cost = unit_price;
      count.entries.push_back({j, 1.0});
    }
    for (std::size_t i = 0; i < table_.rows(); ++i)
      model_.columns[table_.columns() + i].cost = price * weights_[i];
    model_.rows.push_back(std::move(count));

    Outcome outcome{.bound = weights_.total()};
    const auto learn = [&](double dual_bound) {
      // The dual bound d of count + price missed, with count <= units < price, proves missed >= (d - units) /
      // price.
      const double bound = (dual_bound - unit_price * static_cast<double>(units)) / price;
      const double missed = weights_.are_whole() ? std::ceil(bound - 1e-6) : bound * (1 - 1e-9);
      if (missed > 0)
        outcome.bound = std::min(outcome.bound, weights_.total() - std::min(weights_.total(), missed));
    };
    const auto fits = [&](const std::vector<std::uint32_t>& selected, const Check&) {
      return selected.size() <= units;
    };
    const double known =
        unit_price * static_cast<double>(known_units) + price * (weights_.total() - known_weight);
    return run(outcome, known - unit_price / 2, learn, fits, solve, time_limit_s, control);
  }

  /// The minimum number of units that reach the weight `target`. If that of a selection is known, only
  /// smaller ones are sought.
  Outcome minimise(double target, std::optional<std::size_t> known_units, const SolveFunction& solve,
                   double time_limit_s, const RunControl& control) {
    double max_weight = 0;
    for (std::size_t i = 0; i < table_.rows(); ++i) max_weight = std::max(max_weight, weights_[i]);
    const double scale = max_weight > 0 ? 1 / max_weight : 1;
    // Half a step keeps the row valid in spite of the solver's tolerance.
    milp::Row missed{
        -milp::infinity, scale * (weights_.total() - target + weights_.step() / 2), {}, "missed"};
    for (std::uint32_t j = 0; j < table_.columns(); ++j) model_.columns[j].cost = 1;
    for (std::size_t i = 0; i < table_.rows(); ++i) {
      const auto column = static_cast<std::uint32_t>(table_.columns() + i);
      model_.columns[column].cost = 0;
      if (weights_[i] > 0) missed.entries.push_back({column, scale * weights_[i]});
    }
    model_.rows.push_back(std::move(missed));

    Outcome outcome;
    const auto learn = [&](double dual_bound) {
      outcome.bound = std::max(outcome.bound, std::ceil(dual_bound - 1e-6));
    };
    const auto fits = [&](const std::vector<std::uint32_t>&, const Check& check) {
      return weights_.without(check.unmet) >= target;
    };
    const double cutoff = known_units ? static_cast<double>(*known_units) - 0.5 : milp::infinity;
    return run(outcome, cutoff, learn, fits, solve, time_limit_s, control);
  }

 private:
  static constexpr std::size_t max_entries = 400'000;

  // Solves the model until the checker agrees with the solver about the labels that a solution reaches.
  template <class Learn, class Fits>
  Outcome run(Outcome& outcome, double cutoff, const Learn& learn, const Fits& fits,
              const SolveFunction& solve, double time_limit_s, const RunControl& control) {
    const Deadline deadline(time_limit_s);
    while (!deadline.has_passed() && !control.cancelled()) {
      const milp::Result result =
          solve(model_, {.time_limit_s = deadline.seconds_left(), .cutoff = cutoff}, control);
      if (result.termination == milp::Termination::infeasible) {
        outcome.is_infeasible = cutoff == milp::infinity;
        if (!outcome.is_infeasible) learn(cutoff - milp::objective_slack(model_, cutoff));
        break;
      }
      const bool empty_handed = result.solution.empty() && !model_.columns.empty();
      const bool wrong =
          !empty_handed && milp::violation(model_, result.solution) > milp::feasibility_tolerance;
      if (wrong || result.termination == milp::Termination::error) {
        outcome.failed = true;
        break;
      }
      learn(result.dual_bound - milp::objective_slack(model_, result.dual_bound));
      if (empty_handed) break;
      std::vector<std::uint32_t> selected;
      for (std::uint32_t j = 0; j < table_.columns(); ++j)
        if (result.solution[j] > 0.5) selected.push_back(j);
      const Check check = check_selection(table_, problem_, selected);
      bool mistaken = false;
      for (const std::uint32_t i : check.unmet) {
        if (result.solution[table_.columns() + i] > 0.5) continue;
        cut_off(selected, i);
        mistaken = true;
      }
      const bool is_wanted = check.allowed() && fits(selected, check);
      if (is_wanted) outcome.selected = selected;
      outcome.failed = !check.allowed() || (!is_wanted && !mistaken);
      if (outcome.failed || !mistaken || result.termination != milp::Termination::optimal) break;
    }
    return outcome;
  }

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
  const LabelWeights& weights_;
  milp::Model model_;
};

}  // namespace shelfbeam::detail
