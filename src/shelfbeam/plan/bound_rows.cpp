#include "shelfbeam/plan/bound_rows.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <utility>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/stats/distributions.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t rows_at_once = 16;

std::uint32_t strongest_of(const SignalTable& table, LabelId row) {
  const auto entries = table.row(row);
  const auto best = std::max_element(entries.begin(), entries.end(),
                                     [](const auto& a, const auto& b) { return a.signal < b.signal; });
  return best == entries.end() ? std::numeric_limits<std::uint32_t>::max() : std::uint32_t{best->transceiver};
}

// The first labels in `order`, spread over the shop: one per strongest unit.
std::vector<LabelId> spread(const SignalTable& table, std::vector<std::pair<double, LabelId>> order) {
  std::sort(order.begin(), order.end());
  std::vector<LabelId> rows;
  std::set<std::uint32_t> seen;
  for (const auto& [worth, row] : order) {
    if (rows.size() == rows_at_once) break;
    if (seen.insert(strongest_of(table, row)).second) rows.push_back(row);
  }
  return rows;
}

// The largest signal that `units` units can contribute together, as a share of the requirement.
double max_of(const SignalTable& table, const PlacementProblem& problem, LabelId row, std::size_t units) {
  std::vector<double> signals;
  for (const SignalEntry& entry : table.row(row)) signals.push_back(entry.signal);
  const std::size_t count = std::min(units, signals.size());
  std::partial_sort(signals.begin(), signals.begin() + static_cast<std::ptrdiff_t>(count), signals.end(),
                    std::greater<>());
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += signals[k];
  return sum / requirement_of(table.labels[row], problem.model);
}

}  // namespace

SignalTable table_of_rows(const SignalTable& table, const std::vector<LabelId>& rows) {
  SignalTable part;
  part.transceivers = table.transceivers;
  part.mounts = table.mounts;
  part.conflicts = table.conflicts;
  part.row_begin = {0};
  for (const LabelId i : rows) {
    part.labels.push_back(table.labels[i]);
    const auto row = table.row(i);
    part.entries.insert(part.entries.end(), row.begin(), row.end());
    part.row_begin.push_back(part.entries.size());
  }
  return part;
}

constexpr double share_of_entries = 0.8, share_of_sums = 0.1, share_of_rare = 0.1;

// The columns of a row in descending order of signal.
std::vector<std::uint32_t> by_strength(const SignalTable& planned, LabelId row) {
  std::vector<double> signal(planned.columns(), 0.0);
  for (const SignalEntry& entry : planned.row(row)) signal[entry.transceiver] = entry.signal;
  return ordered_by(planned.columns(), [&](std::uint32_t j) { return -signal[j]; });
}

struct LimitLevels {
  double entry = 0, sum = 0, rare = 0;
};

// `sums` contains the columns of a row in `order`, then for each column the sum from it to the last.
void add_limits(SignalTable& table, std::span<const ValidationEstimate> sums,
                const std::vector<std::uint32_t>& order, const LimitLevels& level, double largest,
                double requirement) {
  const std::size_t n = order.size();
  std::vector<double> limit(n);
  double of_sum = 0;  // sampled part of the shortest sum with entry k that was hit often enough
  for (std::size_t k = 0; k < n; ++k) {
    const ValidationEstimate& own = sums[k];
    const ValidationEstimate& sum = sums[n + k];
    if (!sum.is_rare())
      of_sum = std::max(0.0, sum.upper(level.sum) - sum.known);
    else if (k == 0)
      of_sum = sum.rare_upper(level.rare, largest, requirement) - sum.known;
    limit[order[k]] = own.is_rare() ? own.known + of_sum : own.upper(level.entry);
  }
  for (std::uint32_t j = 0; j < n; ++j)
    if (limit[j] > 0) table.entries.push_back({j, limit[j]});
  table.row_begin.push_back(table.entries.size());
}

UpperConfidenceRows upper_confidence_rows(const PreparedScene& prepared, const SignalTable& planned,
                                          const BatchRequest& request, double level, LimitCounts counts,
                                          const RunControl& control) {
  const std::size_t n = planned.columns();
  const std::vector<LabelId> rows(request.labels.begin(), request.labels.end());
  std::vector<std::vector<std::uint32_t>> orders;
  orders.reserve(rows.size());
  for (const LabelId i : rows) orders.push_back(by_strength(planned, i));
  const SumRule rule = [&](std::size_t label, std::span<const double> values, std::span<double> sums) {
    double sum = 0;
    for (std::size_t k = n; k-- > 0;) {
      sums[k] = values[orders[label][k]];
      sums[n + k] = sum += sums[k];
    }
  };
  const ValidationEstimates fresh = validation_estimates(prepared, request, 2 * n, rule, control);
  UpperConfidenceRows result{table_of_rows(planned, rows), {}};
  result.table.entries.clear();
  result.table.row_begin = {0};
  const LimitLevels levels{
      share_of_entries * level / static_cast<double>(counts.entries),
      share_of_sums * level / static_cast<double>(counts.sums),
      share_of_rare * level / static_cast<double>(std::max<std::size_t>(1, rows.size()))};
  for (std::size_t k = 0; k < rows.size(); ++k)
    add_limits(result.table, fresh.of(k), orders[k], levels, fresh.largest,
               result.table.labels[k].requirement);
  for (std::size_t k = 0; k < rows.size(); ++k)
    result.fresh.push_back(validation_row(fresh, k, rows[k], orders[k]));
  return result;
}

// The error of a flagged entry may be larger than estimated.
constexpr double errors_of_flagged = 3;

void raise_row(SignalTable& table, const SignalMatrix& matrix, std::size_t i, double errors) {
  for (std::size_t e = table.row_begin[i]; e < table.row_begin[i + 1]; ++e) {
    SignalEntry& entry = table.entries[e];
    const std::size_t at = matrix.at(i, entry.transceiver);
    const double times = matrix.is_flagged(at) ? errors_of_flagged * errors : errors;
    entry.signal = std::max(0.0, entry.signal + times * static_cast<double>(matrix.standard_error[at]));
  }
}

double expected_errors(double level, LimitCounts counts, std::uint32_t batches) {
  constexpr double reserve = 1.1;  // errors of the new batches may be larger
  return -reserve *
         student_quantile(share_of_entries * level / static_cast<double>(counts.entries), batches - 1);
}

SignalTable raised_table(const SignalTable& planned, const SignalMatrix& matrix, double errors,
                         double samples, double planned_errors) {
  SignalTable table = planned;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const double ratio = std::sqrt(static_cast<double>(matrix.labels[i].samples) / samples);
    raise_row(table, matrix, i, errors * ratio + planned_errors);
  }
  return table;
}

CoreRows core_rows(const SignalTable& table, const BoundGoal& goal, double cost, const PlaceOptions& given,
                   const RunControl& control) {
  const PlacementProblem& problem = goal.problem;
  const Deadline deadline(given.time_limit_s);
  std::vector<std::pair<double, LabelId>> order;
  for (std::uint32_t i = 0; i < table.rows(); ++i)
    order.emplace_back(max_of(table, problem, i, std::max<std::size_t>(1, goal.max_units_below(cost))), i);
  CoreRows decisive;
  decisive.rows = spread(table, std::move(order));
  std::sort(decisive.rows.begin(), decisive.rows.end());
  PlaceOptions options = given;
  while ((options.step_limit || !deadline.has_passed()) && !control.cancelled()) {
    options.time_limit_s = deadline.seconds_left();
    options.settles_ties = false;
    const Placement answer =
        place(goal.priced(table_of_rows(table, decisive.rows)), problem, options, control);
    decisive.suffice = goal.bound_of(answer) >= cost;
    if (decisive.suffice || !answer.has_selection() || answer.objective_value >= cost) break;
    const Check check = check_selection(table, problem, answer.selected);
    order.clear();
    for (const LabelId i : check.unmet)
      order.emplace_back(check.signal[i] / requirement_of(table.labels[i], problem.model), i);
    if (order.empty()) {
      decisive.counterexample = answer.selected;
      break;
    }
    for (const LabelId row : spread(table, std::move(order))) decisive.rows.push_back(row);
    std::sort(decisive.rows.begin(), decisive.rows.end());
  }
  return decisive;
}

}  // namespace shelfbeam
