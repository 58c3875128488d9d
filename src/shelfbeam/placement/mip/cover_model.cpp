#include "shelfbeam/placement/mip/cover_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/math/order.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/placement/problem/cover_rows.hpp"

namespace shelfbeam::detail {

namespace {

// Solvers silently drop coefficients of about this size. Removing them here and subtracting their sum from
// the right-hand side is a relaxation: bounds stay valid, and the checker tests selections.
constexpr double negligible = 1e-8;

// Solvers compare sums with tolerances of 1e-9 to 1e-7, in presolve to either side, and may prune wrongly
// within them. Coefficients are therefore rounded up to this grid, another relaxation: a feasible selection
// attains 1 exactly, and no sum is within half a step of the row's bound.
constexpr double grid_steps = 1 << 20;

}  // namespace

milp::Row relaxed(milp::Row row) {
  row.lower = 1 - 0.5 / grid_steps;
  for (milp::Entry& entry : row.entries) {
    if (entry.value < negligible) row.lower -= entry.value;
    entry.value =
        entry.value < negligible ? 0 : std::ceil(std::min(entry.value, 1.0) * grid_steps) / grid_steps;
  }
  std::erase_if(row.entries, [](const milp::Entry& entry) { return entry.value == 0; });
  return row;
}

CoverModel::CoverModel(const Instance& instance, const milp::SolveFunction& solve, const Effort& effort,
                       const RunControl& control, const MipKnowledge& knowledge,
                       std::span<const double> weights)
    : instance_(instance),
      solve_(solve),
      control_(control),
      knowledge_(knowledge),
      weights_(weights),
      effort_(effort) {}

bool CoverModel::fits_with_misses(const Instance& instance) {
  constexpr std::size_t max_entries = 400'000;
  std::size_t entries = instance.table.entries.size();
  if (instance.problem.redundant && instance.is_cooperative())
    for (std::size_t i = 0; i < instance.rows(); ++i)
      entries += instance.row(i).size() * instance.row(i).size();
  return entries <= max_entries;
}

void CoverModel::build() {
  model_ = model_without_failures(instance_);
  built_ = true;
  if (instance_.is_cooperative())
    for (std::size_t i = 0; i < instance_.rows(); ++i) model_.rows[i] = relaxed(std::move(model_.rows[i]));
  model_.rows.insert(model_.rows.end(), knowledge_.cuts.begin(), knowledge_.cuts.end());
  // In rows of 0 and 1 that are met by one unit, u_i need not be declared integer.
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    model_.columns.push_back({0, 0, 1, !instance_.is_cover(), {}});
    model_.rows[i].entries.push_back({missed(i), instance_.problem.redundant ? 2.0 : 1.0});
  }
  if (!fails_by_rows()) return;
  for (std::size_t i = 0; i < instance_.rows(); ++i) {
    const auto row = instance_.row(i);
    const auto strongest = std::ranges::max_element(row, {}, &SignalEntry::signal);
    if (strongest != row.end()) add_failure(i, strongest->transceiver);
  }
}

// The right-hand side follows the grid as in `relaxed`, and u_i fills the row exactly.
void CoverModel::bound_label_rows(std::size_t max_units) {
  if (!fails_by_rows()) return;
  const CoverRows cover(instance_, max_units);
  for (std::size_t i = 0; i < instance_.rows(); ++i) {
    double without = 0;
    for (const SignalEntry& entry : instance_.row(i))
      if (const double share = entry.signal / instance_.table.labels[i].requirement; share < negligible)
        without += share;
    milp::Row& row = model_.rows[i];
    row.lower = (std::ceil((cover.bound(i) - without) * grid_steps) - 0.5) / grid_steps;
    if (may_miss()) row.entries.back().value = row.lower;
  }
}

bool CoverModel::add_failure(std::size_t label, std::uint32_t failed) {
  if (!failures_.emplace(label, failed).second) return false;
  milp::Row& row = model_.rows.emplace_back(relaxed(failure_row(instance_.table, label, failed)));
  if (may_miss()) row.entries.push_back({missed(label), 1.0});
  return true;
}

// Adds the failure rows that the selection violates; false if the model contains them all.
bool CoverModel::add_failure_rows(const Selection& selected, const std::vector<LabelId>& unmet) {
  if (!fails_by_rows()) return false;
  const std::vector<bool> chosen = marked(instance_.columns(), selected);
  bool added = false;
  for (const LabelId i : unmet) {
    double sum = 0, largest = 0;
    for (const SignalEntry& entry : instance_.row(i)) {
      if (!chosen[entry.transceiver]) continue;
      sum += entry.signal;
      largest = std::max(largest, entry.signal);
    }
    const double requirement = instance_.table.labels[i].requirement;
    for (const SignalEntry& entry : instance_.row(i)) {
      if (!chosen[entry.transceiver]) continue;
      const bool breaks = entry.signal == largest || sum - entry.signal < requirement;
      if (breaks && add_failure(i, entry.transceiver)) added = true;
    }
  }
  return added;
}

// Sets the costs; returns the rows that limit the number of units and the missed weight, as a multiple of the
// largest weight.
std::vector<milp::Row> CoverModel::set_goal(const MipGoal& goal, const CostBounds& bounds) {
  const double max_cost = std::min(goal.known, knowledge_.cutoff);
  for (std::size_t j = 0; j < goal.cost.size(); ++j) {
    milp::Column& column = model_.columns[j];
    const bool too_dear = column.lower == 0 && goal.cost[j] > max_cost * (1 + 1e-9);
    column.cost = too_dear ? 0 : goal.cost[j];
    column.upper = too_dear ? 0 : 1;
  }
  for (const ColumnId j : knowledge_.without) model_.columns[j].upper = model_.columns[j].cost = 0;
  bound_label_rows(std::min(goal.max_count, bounds.affordable(max_cost)));
  std::vector<milp::Row> rows;
  if (goal.min_count > 0 || goal.max_count < instance_.columns())
    rows.push_back(milp::sum_row(all_numbers(instance_.columns()), static_cast<double>(goal.min_count),
                                 static_cast<double>(goal.max_count)));
  const double largest = may_miss() ? *std::max_element(weights_.begin(), weights_.end()) : 0;
  for (std::size_t i = 0; i < weights_.size(); ++i)
    model_.columns[missed(i)].cost = goal.price_of_misses * weights_[i];
  if (largest > 0 && goal.max_missed < milp::infinity) {
    milp::Row& weight = rows.emplace_back();
    weight.upper = goal.max_missed / largest;
    for (std::size_t i = 0; i < weights_.size(); ++i)
      if (weights_[i] > 0) weight.entries.push_back({missed(i), weights_[i] / largest});
  }
  return rows;
}

CoverModel::Outcome CoverModel::minimise(const MipGoal& goal) {
  Outcome outcome;
  if (effort_.is_over(control_)) return outcome;
  if (!built_) build();
  const CostBounds bounds(instance_.table, goal.cost);
  const std::vector<milp::Row> of_goal = set_goal(goal, bounds);
  const bool has_cutoff = knowledge_.cutoff < milp::infinity;
  const double step = may_miss() ? 0 : bounds.step();
  double best = milp::infinity;  // the value of outcome.selected
  while (!effort_.is_over(control_)) {
    const std::size_t rows = model_.rows.size();
    model_.rows.insert(model_.rows.end(), of_goal.begin(), of_goal.end());
    const milp::Result result = solve_(model_,
                                       {.time_limit_s = effort_.seconds_left(),
                                        .node_limit = node_limit(effort_),
                                        .relative_gap = step > 0 ? 1e-9 : 1e-6,
                                        .cutoff = knowledge_.cutoff,
                                        .step = step},
                                       control_);
    const bool empty_handed = result.solution.empty() && !model_.columns.empty();
    const bool wrong =
        !empty_handed && milp::violation(model_, result.solution) > milp::feasibility_tolerance;
    model_.rows.resize(rows);

    // Rows relax the rule and cuts keep every feasible selection, so this is a proof unless a selection is
    // known.
    const auto safe = [&](double bound) {
      return bound - (result.is_safe ? 0 : milp::objective_slack(model_, bound));
    };
    if (result.termination == milp::Termination::infeasible && (goal.known == milp::infinity || has_cutoff)) {
      // A solver does not see costs within its tolerance of the cut-off.
      outcome.failed = !has_cutoff && outcome.selected;  // a contradiction
      outcome.infeasible = !outcome.failed && (!has_cutoff || result.is_safe);
      if (has_cutoff) outcome.bound = std::max(outcome.bound, safe(knowledge_.cutoff));
      break;
    }
    if (wrong || result.termination == milp::Termination::error ||
        result.termination == milp::Termination::infeasible) {
      outcome.failed = true;
      break;
    }
    outcome.bound = std::max(outcome.bound, safe(result.dual_bound));
    if (empty_handed) break;
    const Selection selected = numbers_where<ColumnId>(
        instance_.columns(), [&](std::uint32_t j) { return result.solution[j] > 0.5; });
    const Check check = instance_.check(selected);
    std::vector<LabelId> mistaken = check.unmet;  // labels that the solver counts as reached
    double missed_weight = 0;
    if (may_miss()) {
      std::erase_if(mistaken,
                    [&](LabelId i) { return result.solution[missed(i)] > 0.5 || !(weights_[i] > 0); });
      for (const LabelId i : check.unmet) missed_weight += weights_[i];
    }
    double value = goal.price_of_misses * missed_weight;
    for (const ColumnId j : selected) value += goal.cost[j];
    const bool is_wanted =
        check.allowed() && (may_miss() ? missed_weight <= goal.max_missed : mistaken.empty());
    const bool is_optimal = result.termination == milp::Termination::optimal;
    if (is_wanted && value < best) {
      best = value;
      outcome.selected = selected;
    }
    outcome.failed = !check.allowed();  // a conflict, against the rows of the model
    if (outcome.failed || !is_optimal || (mistaken.empty() && is_wanted)) break;
    if (mistaken.empty()) {
      forbid_misses(check.unmet);
    } else if (!add_failure_rows(selected, mistaken)) {
      for (const LabelId i : mistaken) {
        cut_off(selected, i);
        if (!may_miss() || effort_.is_over(control_)) break;
      }
    }
  }
  return outcome;
}

// These labels weigh more than may be missed, though by less than the solver's tolerance.
void CoverModel::forbid_misses(std::span<const LabelId> labels) {
  milp::Row& row = model_.rows.emplace_back();
  row.upper = static_cast<double>(labels.size()) - 1;
  for (const LabelId i : labels) row.entries.push_back({missed(i), 1.0});
}

// The selection misses the label, and so does every part of it (signals are not negative). It is extended by
// the units with the weakest signals at the label while the label stays missed. Then one of the other units
// must be chosen.
void CoverModel::cut_off(const Selection& selected, std::size_t unmet_label) {
  std::vector<double> signal(instance_.columns(), 0.0);
  for (const SignalEntry& entry : instance_.row(unmet_label)) signal[entry.transceiver] = entry.signal;
  std::vector<bool> chosen = marked(instance_.columns(), selected);
  Selection outside =
      numbers_where<ColumnId>(instance_.columns(), [&](std::uint32_t j) { return !chosen[j]; });
  std::ranges::stable_sort(outside, {}, [&](ColumnId j) { return signal[j]; });

  auto first = outside.begin();
  for (; first != outside.end(); ++first) {
    chosen[*first] = true;
    if (instance_.is_reached(unmet_label, chosen)) break;
  }
  milp::Row& cut =
      model_.rows.emplace_back(milp::sum_row(std::span(first, outside.end()), 1, milp::infinity, "cut"));
  if (may_miss()) cut.entries.push_back({missed(unmet_label), 1.0});
}

}  // namespace shelfbeam::detail
