#include "shelfbeam/placement/mip/cover_model.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/bounds.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

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

CoverModel::CoverModel(const SignalTable& table, const PlacementProblem& problem, const SolveFunction& solve,
                       double time_limit_s, const RunControl& control, const MipKnowledge& knowledge)
    : table_(table),
      problem_(problem),
      solve_(solve),
      control_(control),
      knowledge_(knowledge),
      deadline_(time_limit_s) {}

void CoverModel::build() {
  model_ = model_without_failures(table_, problem_);
  built_ = true;
  if (problem_.model == CommunicationModel::cooperative)
    for (std::size_t i = 0; i < table_.rows(); ++i) model_.rows[i] = relaxed(std::move(model_.rows[i]));
  model_.rows.insert(model_.rows.end(), knowledge_.cuts.begin(), knowledge_.cuts.end());
  if (problem_.model == CommunicationModel::non_cooperative) return;
  if (!problem_.redundant) return;
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    const auto row = table_.row(i);
    const auto strongest =
        std::max_element(row.begin(), row.end(),
                         [](const SignalEntry& a, const SignalEntry& b) { return a.signal < b.signal; });
    if (strongest != row.end()) add_failure(i, strongest->transceiver);
  }
}

// The rows (i, j) of the k chosen units that reach label i add up to (k - 1) sum_j a_ij T_j >= k. As k / (k -
// 1) falls with k, any upper bound on k is valid. The right-hand side follows the grid as in `relaxed`.
void CoverModel::bound_label_rows(std::size_t max_units) {
  if (!problem_.redundant || problem_.model == CommunicationModel::non_cooperative) return;
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    const auto units =
        static_cast<double>(std::max<std::size_t>(2, std::min(max_units, table_.row(i).size())));
    double without = 0;
    for (const SignalEntry& entry : table_.row(i))
      if (const double share = entry.signal / table_.labels[i].requirement; share < negligible)
        without += share;
    const double min_sum = (1 - 2 * met_tolerance) * units / (units - 1) - without;
    model_.rows[i].lower = (std::ceil(min_sum * grid_steps) - 0.5) / grid_steps;
  }
}

bool CoverModel::add_failure(std::size_t label, std::uint32_t failed) {
  if (!failures_.emplace(label, failed).second) return false;
  model_.rows.push_back(relaxed(failure_row(table_, label, failed)));
  return true;
}

// Adds the failure rows that the selection violates; false if the model contains them all.
bool CoverModel::add_failure_rows(const std::vector<std::uint32_t>& selected,
                                  const std::vector<std::uint32_t>& unmet) {
  if (!problem_.redundant || problem_.model == CommunicationModel::non_cooperative) return false;
  std::vector<bool> chosen(table_.columns(), false);
  for (const std::uint32_t j : selected) chosen[j] = true;
  bool added = false;
  for (const std::uint32_t i : unmet) {
    double sum = 0, largest = 0;
    for (const SignalEntry& entry : table_.row(i)) {
      if (!chosen[entry.transceiver]) continue;
      sum += entry.signal;
      largest = std::max(largest, entry.signal);
    }
    const double requirement = table_.labels[i].requirement;
    for (const SignalEntry& entry : table_.row(i)) {
      if (!chosen[entry.transceiver]) continue;
      const bool breaks = entry.signal == largest || sum - entry.signal < requirement;
      if (breaks && add_failure(i, entry.transceiver)) added = true;
    }
  }
  return added;
}

CoverModel::Outcome CoverModel::minimise(std::span<const double> cost, double known,
                                         std::optional<std::size_t> count) {
  Outcome outcome;
  if (deadline_.has_passed() || control_.cancelled()) return outcome;
  if (!built_) build();
  for (std::size_t j = 0; j < cost.size(); ++j) {
    milp::Column& column = model_.columns[j];
    const bool too_dear = column.lower == 0 && cost[j] > std::min(known, knowledge_.cutoff) * (1 + 1e-9);
    column.cost = too_dear ? 0 : cost[j];
    column.upper = too_dear ? 0 : 1;
  }
  for (const std::uint32_t j : knowledge_.without) model_.columns[j].upper = model_.columns[j].cost = 0;
  bound_label_rows(count ? *count : CostBounds(table_, cost).affordable(std::min(known, knowledge_.cutoff)));
  milp::Row count_row;
  if (count) {
    count_row.lower = count_row.upper = static_cast<double>(*count);
    for (std::uint32_t j = 0; j < table_.columns(); ++j) count_row.entries.push_back({j, 1.0});
  }

  while (!deadline_.has_passed() && !control_.cancelled()) {
    if (count) model_.rows.push_back(count_row);
    const double step = CostBounds(table_, cost).step();
    const milp::Result result = solve_(model_,
                                       {.time_limit_s = deadline_.seconds_left(),
                                        .relative_gap = step > 0 ? 1e-9 : 1e-6,
                                        .cutoff = knowledge_.cutoff,
                                        .step = step},
                                       control_);
    const bool empty_handed = result.solution.empty() && !model_.columns.empty();
    const bool wrong =
        !empty_handed && milp::violation(model_, result.solution) > milp::feasibility_tolerance;
    if (count) model_.rows.pop_back();

    // Rows relax the rule and cuts keep every feasible selection, so this is a proof unless a selection is
    // known.
    const bool has_cutoff = knowledge_.cutoff < milp::infinity;
    if (result.termination == milp::Termination::infeasible && (known == milp::infinity || has_cutoff)) {
      // A solver does not see costs within its tolerance of the cut-off.
      outcome.infeasible = !has_cutoff || result.is_safe;
      if (!outcome.infeasible)
        outcome.bound = knowledge_.cutoff - milp::objective_slack(model_, knowledge_.cutoff);
      break;
    }
    if (wrong || result.termination == milp::Termination::error ||
        result.termination == milp::Termination::infeasible) {
      outcome.failed = true;
      break;
    }
    const double tolerance = result.is_safe ? 0 : milp::objective_slack(model_, result.dual_bound);
    outcome.bound = std::max(outcome.bound, result.dual_bound - tolerance);
    if (empty_handed) break;
    std::vector<std::uint32_t> selected;
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (result.solution[j] > 0.5) selected.push_back(j);
    const Check check = check_selection(table_, problem_, selected);
    if (check.met()) {
      outcome.proven = result.termination == milp::Termination::optimal &&
                       supports(outcome.bound, milp::objective(model_, result.solution), cost);
      outcome.selected = std::move(selected);
      break;
    }
    if (result.termination != milp::Termination::optimal) break;
    if (check.unmet.empty()) {  // a conflict, against the model's row
      outcome.failed = true;
      break;
    }
    if (!add_failure_rows(selected, check.unmet)) cut_off(selected, check.unmet.front());
  }
  return outcome;
}

bool CoverModel::supports(double bound, double value, std::span<const double> cost) const {
  const CostBounds bounds(table_, cost);
  if (bounds.step() > 0) return bounds.rounded(bound) >= value - bounds.tolerance(value);
  constexpr double gap = 1e-6;
  return value - bound <= gap * value;
}

// The selection misses the label, and so does every part of it (signals are not negative). It is extended by
// the units with the weakest signals at the label while the label stays missed. Then one of the other units
// must be chosen.
void CoverModel::cut_off(const std::vector<std::uint32_t>& selected, std::size_t unmet_label) {
  std::vector<double> signal(table_.columns(), 0.0);
  for (const SignalEntry& entry : table_.row(unmet_label)) signal[entry.transceiver] = entry.signal;
  std::vector<bool> chosen(table_.columns(), false);
  for (const std::uint32_t j : selected) chosen[j] = true;
  std::vector<std::uint32_t> outside;
  for (std::uint32_t j = 0; j < table_.columns(); ++j)
    if (!chosen[j]) outside.push_back(j);
  std::stable_sort(outside.begin(), outside.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return signal[a] < signal[b]; });

  const double requirement = requirement_of(table_.labels[unmet_label], problem_.model);
  auto first = outside.begin();
  for (; first != outside.end(); ++first) {
    chosen[*first] = true;
    if (is_met(received_signal(table_, unmet_label, chosen, problem_), requirement)) break;
  }
  milp::Row cut{1.0, milp::infinity, {}, "cut"};
  for (; first != outside.end(); ++first) cut.entries.push_back({*first, 1.0});
  model_.rows.push_back(std::move(cut));
}

}  // namespace shelfbeam::detail
