#include "shelfbeam/plan/bound_rounds.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"

namespace shelfbeam {

namespace {

// By how many standard errors of the matrix an entry must be too weak to count as such beforehand.
constexpr double errors_of_fixed = 2;
// Share of the budget that is left, for the search for core rows.
constexpr double share_of_search = 0.1;

bool is_strong(const SignalTable& table, LabelId label, double signal, CommunicationModel model) {
  return is_met(signal, requirement_of(table.labels[label], model));
}

// Entries that are too weak on `planned` although their upper limit on `fresh` is not: row by row.
bool has_refuted_entry(const SignalTable& planned, const SignalTable& fresh, CommunicationModel model) {
  std::vector<bool> counts(planned.columns());
  for (std::uint32_t i = 0; i < planned.rows(); ++i) {
    std::fill(counts.begin(), counts.end(), false);
    for (const SignalEntry& entry : planned.row(i))
      counts[entry.transceiver] = is_strong(planned, i, entry.signal, model);
    for (const SignalEntry& entry : fresh.row(i))
      if (!counts[entry.transceiver] && is_strong(planned, i, entry.signal, model)) return true;
  }
  return false;
}

}  // namespace

void BoundRounds::aim(const SignalTable& table, const Placement& placement) {
  goal_ = bound_goal(table, placement);
  value_ = minimises_cost(goal_.problem) ? placement.objective_value : static_cast<double>(placement.count());
  raise(trivial_bound(goal_, table), 0);
}

double BoundRounds::proven() const {
  return goal_.is_count ? static_cast<double>(certificate_.count_lower_bound) : certificate_.cost_lower_bound;
}

void BoundRounds::raise(double bound, std::size_t labels) {
  bound = std::min(bound, goal_.value);
  if (!(bound > proven())) return;
  if (goal_.is_count) certificate_.count_lower_bound = static_cast<std::size_t>(bound);
  if (minimises_cost(goal_.problem)) certificate_.cost_lower_bound = bound;
  certificate_.bound_labels = labels;
  if (holds()) obstacle_.reset();
}

void BoundRounds::set_obstacle(double bound, double cost) {
  obstacle_ = {.cause = EndCause::proof_cost,
               .bound = bound,
               .bounds_cost = !goal_.is_count,
               .seconds = rounds_.in_seconds(cost)};
}

bool BoundRounds::prove(const PlannedSignals& signals) {
  if (goal_.problem.model == CommunicationModel::non_cooperative || goal_.problem.redundant)
    return prove_by_entries(signals);
  const std::vector<double> targets = goal_.targets(proven());
  // A bound that takes much of the budget waits for smaller ones that take little.
  constexpr double little = 0.25;
  const auto prove_one = [&](double share) {
    return std::any_of(targets.begin(), targets.end(),
                       [&](double bound) { return refute(bound, signals, share); });
  };
  return (targets.size() > 1 && prove_one(little)) || prove_one(1);
}

// Returns whether it has tested a refutation of all selections that cost less than the bound.
bool BoundRounds::refute(double bound, const PlannedSignals& signals, double share) {
  BudgetRefuter::Attempt attempt = refuter_.attempt(goal_, bound, signals, share);
  if (!attempt.counterexample.empty()) counterexample_ = std::move(attempt.counterexample);
  if (!attempt.is_tested) {
    if (attempt.cost > 0) set_obstacle(bound, attempt.cost);
    return false;
  }
  fresh_ = std::move(attempt.fresh);
  if (attempt.is_proven) raise(bound, attempt.labels);
  return true;
}

LimitCounts BoundRounds::counts(std::size_t rows, std::size_t columns) const {
  if (goal_.problem.model == CommunicationModel::non_cooperative) return {1, columns};
  const std::size_t units = std::max<std::size_t>(1, goal_.max_units_below(goal_.value));
  return {std::max<std::size_t>(1, rows) * units, std::max<std::size_t>(1, rows) * columns};
}

// The upper limits that new batches are expected to give. Where one unit alone must reach a label, this table
// also fixes the entries that count as too weak, some distance from the requirement.
SignalTable BoundRounds::expected_table(const PlannedSignals& signals, std::size_t rows,
                                        std::uint32_t batches) const {
  const bool is_fixed = goal_.problem.model == CommunicationModel::non_cooperative;
  const double samples = batches * Rounds::samples_per_batch(prepared_);
  const LimitCounts counts = this->counts(rows, signals.table.columns());
  return raised_table(signals.table, *signals.matrix, expected_errors(rounds_.level(), counts, batches),
                      samples, is_fixed ? errors_of_fixed : 0);
}

// Core rows for the goal, expected from the batches of this round or from the smallest larger number that
// suffices. Sets batches_ if there are any.
CoreRows BoundRounds::promising_rows(const PlannedSignals& signals) {
  CoreRows found;
  const Deadline deadline(rounds_.seconds_for(share_of_search, place_.time_limit_s));
  for (std::uint32_t batches = batches_;; batches = Rounds::more(batches)) {
    rounds_.report(Task::proving,
                   fmt::format("core rows to prove that {}, {} batches", goal_.text(goal_.value), batches));
    PlaceOptions options;
    options.time_limit_s = deadline.seconds_left();
    options.step_limit = place_.step_limit;
    CoreRows core =
        core_rows(expected_table(signals, rows_, batches), goal_, goal_.value, options, rounds_.control());
    if (found.rows.empty() || core.suffice) found = std::move(core);
    if (found.suffice) batches_ = batches;
    const bool is_late = deadline.has_passed() || rounds_.control().cancelled();
    if (found.suffice || batches >= Rounds::max_batches || is_late) return found;
  }
}

// The cost of a batch of some labels.
double BoundRounds::cost_of(std::size_t labels) const {
  return rounds_.cost(TracedUnits::all) * static_cast<double>(labels);
}

// Upper limits from independent batches, if the budget allows these.
std::optional<SignalTable> BoundRounds::upper_limits(const SignalTable& table,
                                                     const std::vector<LabelId>& labels,
                                                     const LimitCounts& counts) {
  const std::uint32_t batches = rounds_.affordable(batches_, batches_, cost_of(labels.size()));
  if (batches == 0) return std::nullopt;
  rounds_.report(Task::proving, fmt::format("{} labels, {} batches", labels.size(), batches));
  const double begun = rounds_.spent();
  UpperConfidenceRows upper =
      upper_confidence_rows(prepared_, table, rounds_.request(Purpose::bound, labels, batches),
                            rounds_.level(), counts, rounds_.control());
  rounds_.measure(begun, upper.fresh);
  fresh_ = std::move(upper.fresh);
  return std::move(upper.table);
}

bool BoundRounds::prove_by_entries(const PlannedSignals& signals) {
  const std::uint32_t before = batches_;
  const CoreRows core = promising_rows(signals);
  if (core.rows.empty()) return false;
  obstacle_.reset();
  std::optional<SignalTable> rows =
      upper_limits(signals.table, core.rows, counts(core.rows.size(), signals.table.columns()));
  if (!rows) {
    set_obstacle(goal_.value, cost_of(core.rows.size()) * batches_);
    batches_ = before;
    return false;
  }
  rows_ = std::max(rows_, core.rows.size());
  bool holds_fixed = true;
  if (goal_.problem.model == CommunicationModel::non_cooperative) {
    SignalTable fixed =
        table_of_rows(expected_table(signals, core.rows.size(), fresh_.front().batches), core.rows);
    holds_fixed = !has_refuted_entry(fixed, *rows, goal_.problem.model);
    rows = std::move(fixed);
  }
  if (holds_fixed) {
    PlaceOptions options = place_;
    options.settles_ties = false;
    if (!rounds_.counts_samples())
      options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, rounds_.left()));
    const Placement cheapest =
        place(goal_.priced(std::move(*rows)), goal_.problem, options, rounds_.control());
    raise(goal_.bound_of(cheapest), core.rows.size());
    if (!holds() && cheapest.has_selection()) counterexample_ = cheapest.selected;
  }
  batches_ = Rounds::more(batches_);
  return true;
}

bool BoundRounds::prove_unreachable(const SignalTable& table, const Placement& placement) {
  std::vector<LabelId> labels;
  for (const Unreachable& label : placement.unreachable) labels.push_back(label.label);
  labels.resize(std::min(labels.size(), max_undecided));
  std::sort(labels.begin(), labels.end());
  if (labels.empty()) return false;
  const std::size_t limits = labels.size() * table.columns();
  const std::optional<SignalTable> upper = upper_limits(table, labels, {limits, limits});
  if (!upper) return false;
  PlaceOptions options;
  options.solver = SolverChoice::greedy;
  for (const Unreachable& label : place(*upper, placement.problem, options, rounds_.control()).unreachable) {
    LabelVerdict& verdict = certificate_.labels[labels[label.label]];
    verdict.verdict = Verdict::missed;
    verdict.upper = label.max_signal;
    verdict.samples = fresh_[label.label].samples;
  }
  for (const Unreachable& label : placement.unreachable)
    certificate_.labels[label.label].signal = label.max_signal;
  batches_ = Rounds::more(batches_);
  return true;
}

std::vector<ValidationRow> BoundRounds::take_fresh() {
  return std::exchange(fresh_, {});
}

Selection BoundRounds::take_counterexample() {
  return std::exchange(counterexample_, {});
}

}  // namespace shelfbeam
