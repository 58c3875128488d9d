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

bool is_strong(const SignalTable& table, std::uint32_t label, double signal, CommunicationModel model) {
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
  if (holds()) obstacle_.clear();
}

void BoundRounds::set_obstacle(double bound, double cost, const Rounds& rounds) {
  obstacle_ = fmt::format("proving that {} would take about {:.0f} {}", goal_.text(bound),
                          std::max(1.0, cost), rounds.unit());
}

// Before the first batch of all candidates, that of the chosen units, which takes at least a third of the
// time.
double BoundRounds::cost(const Rounds& rounds, double label_cost) const {
  if (cost_ > 0) return cost_;
  return (rounds.counts_samples() ? 1 : 3) * label_cost;
}

void BoundRounds::measure(const std::vector<ValidationRow>& fresh, double begun, Rounds& rounds) {
  double batches = 0;
  for (const ValidationRow& row : fresh) {
    rounds.spend(row.samples);
    batches += row.batches;
  }
  if (batches > 0) cost_ = std::max(1e-12, (rounds.spent() - begun) / batches);
}

bool BoundRounds::prove(const SignalTable& table, const SignalMatrix& matrix, Rounds& rounds, double level,
                        double label_cost) {
  const double each = cost(rounds, label_cost);
  if (goal_.problem.model == CommunicationModel::non_cooperative || goal_.problem.redundant)
    return prove_by_entries(table, matrix, rounds, level, each);
  const std::vector<double> targets = goal_.targets(proven());
  // A bound that takes much of the budget waits for smaller ones that take little.
  constexpr double little = 0.25;
  const auto prove_one = [&](double share) {
    return std::any_of(targets.begin(), targets.end(), [&](double bound) {
      return refute(bound, table, matrix, rounds, level, each, share);
    });
  };
  return (targets.size() > 1 && prove_one(little)) || prove_one(1);
}

// Returns whether it has tested a refutation of all selections that cost less than the bound.
bool BoundRounds::refute(double bound, const SignalTable& table, const SignalMatrix& matrix, Rounds& rounds,
                         double level, double cost, double share) {
  BudgetRefuter::Attempt attempt = refuter_.attempt(goal_, bound, table, matrix, rounds, level, cost, share);
  if (!attempt.counterexample.empty()) counterexample_ = std::move(attempt.counterexample);
  if (!attempt.is_tested) {
    if (attempt.cost > 0) set_obstacle(bound, attempt.cost, rounds);
    return false;
  }
  measure(attempt.fresh, attempt.begun, rounds);
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
SignalTable BoundRounds::expected_table(const SignalTable& table, const SignalMatrix& matrix, double level,
                                        std::size_t rows, std::uint32_t batches) const {
  const bool is_fixed = goal_.problem.model == CommunicationModel::non_cooperative;
  const double samples = batches * Rounds::samples_per_batch(prepared_);
  return raised_table(table, matrix, expected_errors(level, counts(rows, table.columns()), batches), samples,
                      is_fixed ? errors_of_fixed : 0);
}

// Core rows for the goal, expected from the batches of this round or from the smallest larger number that
// suffices. Sets batches_ if there are any.
CoreRows BoundRounds::promising_rows(const SignalTable& table, const SignalMatrix& matrix,
                                     const Rounds& rounds, double level) {
  CoreRows found;
  const Deadline deadline(rounds.counts_samples() ? place_.time_limit_s
                                                  : share_of_search * std::max(0.0, rounds.left()));
  for (std::uint32_t batches = batches_;; batches = Rounds::more(batches)) {
    control_.report("proving", -1,
                    fmt::format("round {}, core rows to prove that {}, {} batches", rounds.round(),
                                goal_.text(goal_.value), batches));
    PlaceOptions options;
    options.time_limit_s = deadline.seconds_left();
    options.step_limit = place_.step_limit;
    CoreRows core = core_rows(expected_table(table, matrix, level, rows_, batches), goal_, goal_.value,
                              options, control_);
    if (found.rows.empty() || core.suffice) found = std::move(core);
    if (found.suffice) batches_ = batches;
    const bool is_late = deadline.has_passed() || control_.cancelled();
    if (found.suffice || batches >= Rounds::max_batches || is_late) return found;
  }
}

bool BoundRounds::prove_by_entries(const SignalTable& table, const SignalMatrix& matrix, Rounds& rounds,
                                   double level, double cost) {
  const std::uint32_t before = batches_;
  const CoreRows core = promising_rows(table, matrix, rounds, level);
  if (core.rows.empty()) return false;
  obstacle_.clear();
  const double each = cost * static_cast<double>(core.rows.size());
  const std::uint32_t batches = rounds.affordable(batches_, batches_, each);
  if (batches == 0) {
    set_obstacle(goal_.value, each * batches_, rounds);
    batches_ = before;
    return false;
  }
  control_.report("proving", -1,
                  fmt::format("round {}, {} labels, {} batches", rounds.round(), core.rows.size(), batches));
  const double begun = rounds.spent();
  const LimitCounts counts = this->counts(core.rows.size(), table.columns());
  UpperConfidenceRows upper = upper_confidence_rows(
      prepared_, table, rounds.request(Purpose::bound, core.rows, batches), level, counts, control_);
  measure(upper.fresh, begun, rounds);
  fresh_ = std::move(upper.fresh);
  rows_ = std::max(rows_, core.rows.size());
  const bool is_fixed = goal_.problem.model == CommunicationModel::non_cooperative;
  bool holds_fixed = true;
  SignalTable rows = std::move(upper.table);
  if (is_fixed) {
    SignalTable fixed =
        table_of_rows(expected_table(table, matrix, level, core.rows.size(), batches), core.rows);
    holds_fixed = !has_refuted_entry(fixed, rows, goal_.problem.model);
    rows = std::move(fixed);
  }
  if (holds_fixed) {
    PlaceOptions options = place_;
    options.settles_ties = false;
    if (!rounds.counts_samples())
      options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, rounds.left()));
    const Placement cheapest = place(goal_.priced(std::move(rows)), goal_.problem, options, control_);
    raise(goal_.bound_of(cheapest), core.rows.size());
    if (!holds() && cheapest.has_selection()) counterexample_ = cheapest.selected;
  }
  batches_ = Rounds::more(batches_);
  return true;
}

bool BoundRounds::prove_unreachable(const SignalTable& table, const std::vector<std::uint32_t>& labels,
                                    const PlacementProblem& problem, Rounds& rounds, double level,
                                    double label_cost) {
  if (labels.empty()) return false;
  const double each = cost(rounds, label_cost) * static_cast<double>(labels.size());
  const std::uint32_t batches = rounds.affordable(batches_, batches_, each);
  if (batches == 0) return false;
  control_.report("proving", -1,
                  fmt::format("round {}, {} labels, {} batches", rounds.round(), labels.size(), batches));
  const double begun = rounds.spent();
  const std::size_t limits = labels.size() * table.columns();
  UpperConfidenceRows upper = upper_confidence_rows(
      prepared_, table, rounds.request(Purpose::bound, labels, batches), level, {limits, limits}, control_);
  measure(upper.fresh, begun, rounds);
  fresh_ = std::move(upper.fresh);
  PlaceOptions options;
  options.solver = SolverChoice::greedy;
  for (const Unreachable& label : place(upper.table, problem, options, control_).unreachable) {
    LabelVerdict& verdict = certificate_.labels[labels[label.label]];
    verdict.verdict = Verdict::missed;
    verdict.upper = label.max_signal;
    verdict.samples = fresh_[label.label].samples;
  }
  batches_ = Rounds::more(batches_);
  return true;
}

std::vector<ValidationRow> BoundRounds::take_fresh() {
  return std::exchange(fresh_, {});
}

std::vector<std::uint32_t> BoundRounds::take_counterexample() {
  return std::exchange(counterexample_, {});
}

}  // namespace shelfbeam
