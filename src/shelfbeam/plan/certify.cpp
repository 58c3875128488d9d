#include "shelfbeam/plan/certify.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/count_refuter.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/rounds.hpp"

namespace shelfbeam {

namespace {

constexpr auto interrupted = "it was interrupted";
constexpr std::size_t max_doubtful = 64;
constexpr std::uint32_t max_rounds = 30;

void join_sets(std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

class Certifier {
 public:
  Certifier(const PreparedScene& prepared, const TableRule& rule, const CertifyOptions& options,
            SignalMatrix matrix, Placement placement, const RunControl& control)
      : prepared_(prepared),
        rule_(rule),
        options_(options),
        matrix_(std::move(matrix)),
        placement_(std::move(placement)),
        control_(control),
        rounds_(options.confidence, options.budget, options.simulation.seed),
        table_(rule(matrix_)),
        verdicts_(prepared.world().scene, options.simulation, certificate_.labels),
        refuter_(prepared, options.place, control) {
    certificate_.confidence = options.confidence;
    forget_verdicts();
  }

  Certified run() {
    try {
      while (!is_done() && rounds_.round() < max_rounds && run_round()) {
      }
    } catch (const Interrupted&) {
      certificate_.open = interrupted;
    }
    // The placement refers to the matrix on which it was made.
    while (!joined_.empty()) {
      joined_.back().restore(matrix_);
      joined_.pop_back();
    }
    certificate_.seconds = rounds_.seconds();
    return {std::move(matrix_), std::move(placement_), std::move(certificate_)};
  }

 private:
  // Returns whether another round can add something; otherwise sets the reason.
  bool run_round() {
    rounds_.next();
    certificate_.rounds = rounds_.round();
    certificate_.open.clear();
    // Two statements per round, on the labels and on the count, each wrong with probability at most a_r / 2,
    // where a_r = (1 - c) / 2^r. So some statement of some round is wrong with probability at most sum_r a_r
    // = 1 - c, whatever their dependence (Bonferroni).
    const double level = rounds_.level(2);
    bool has_worked = false;
    if (!placement_.has_selection()) {
      has_worked = prove_unreachable(level);
    } else {
      has_worked = verdicts_.verify(rounds_, level, control_) > 0;
      if (!bound_holds() && prove_bound(level)) has_worked = true;
    }
    if (is_done()) return false;
    if (control_.cancelled()) throw Interrupted(interrupted);
    if (rounds_.left() > 0 && improve()) return true;
    if (!certificate_.open.empty()) return false;
    if (has_worked && rounds_.left() > 0) return true;
    certificate_.open = reason_to_stop();
    return false;
  }

  std::string reason_to_stop() const {
    if (!placement_.has_selection())
      return open_labels().empty() ? "each label can be reached alone, but conflicts prevent a selection "
                                     "that reaches all labels"
                                   : "labels are too close to their requirements";
    if (!certificate_.all_reached()) return verdicts_.obstacle(rounds_);
    return bound_obstacle_.empty() ? "signals are too close to requirements for a proof" : bound_obstacle_;
  }

  void forget_verdicts() {
    certificate_.labels.assign(matrix_.rows(), {});
    for (std::size_t i = 0; i < matrix_.rows(); ++i)
      certificate_.labels[i].requirement = matrix_.labels[i].requirement;
    std::vector<float> planned;
    for (std::size_t i = 0; i < matrix_.rows(); ++i)
      for (const std::uint32_t j : placement_.selected) planned.push_back(matrix_.mean[matrix_.at(i, j)]);
    verdicts_.select(placement_.problem, placement_.selected, std::move(planned));
  }

  bool bound_holds() const {
    return placement_.has_selection()
               ? static_cast<double>(certificate_.count_lower_bound) >= placement_.count_lower_bound
               : certificate_.count(Verdict::missed) > 0;
  }
  bool is_done() const {
    return bound_holds() && (!placement_.has_selection() || certificate_.all_reached());
  }

  // Without a selection: labels that no selection seems to reach.
  std::vector<std::uint32_t> open_labels() const {
    std::vector<std::uint32_t> rows;
    for (const Unreachable& label : placement_.unreachable) rows.push_back(label.label);
    rows.resize(std::min(rows.size(), max_doubtful));
    std::sort(rows.begin(), rows.end());
    return rows;
  }

  PlaceOptions in_time() const {
    PlaceOptions options = options_.place;
    if (rounds_.counts_samples()) return options;
    options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, rounds_.left()));
    return options;
  }

  // Limits per row that must hold for a bound: those of the units of one selection that contradicts it, or of
  // the links by which it reaches a label.
  std::size_t signals_at_stake() const {
    if (placement_.problem.model == CommunicationModel::cooperative)
      return std::max<std::size_t>(1, static_cast<std::size_t>(placement_.count_lower_bound) - 1);
    return placement_.problem.redundant ? 2 : 1;
  }

  // The placement that upper confidence limits of some labels' signals require. The batches are kept: if they
  // do not prove the bound, they update the matrix.
  Placement fewest_for(const std::vector<std::uint32_t>& rows, std::size_t signals, double level) {
    control_.report(
        "proving", -1,
        fmt::format("round {}, {} labels, {} batches", rounds_.round(), rows.size(), bound_batches_));
    const double begun = rounds_.spent();
    UpperConfidenceRows upper = upper_confidence_rows(
        prepared_, table_, rounds_.request(Purpose::bound, rows, bound_batches_), level, signals, control_);
    keep(std::move(upper.fresh), begun, rows.size(), bound_batches_);
    PlaceOptions options = in_time();
    options.settles_ties = false;
    return place(upper.table, count_problem(), options, control_);
  }

  // Of a batch of a label for all candidates. Before the first such batch, that of the chosen units, which
  // takes at least a third of the time.
  double expected_cost() const {
    if (bound_cost_ > 0) return bound_cost_;
    return (rounds_.counts_samples() ? 1 : 3) * verdicts_.cost();
  }

  // Keeps new batches for the matrix and measures their cost.
  void keep(std::vector<ValidationRow> fresh, double begun, std::size_t rows, std::uint32_t batches) {
    for (const ValidationRow& row : fresh) rounds_.spend(row.samples);
    bound_cost_ = std::max(1e-12, (rounds_.spent() - begun) / (static_cast<double>(rows) * batches));
    bound_rows_ = std::max(bound_rows_, rows);
    fresh_ = std::move(fresh);
  }

  PlacementProblem count_problem() const {
    PlacementProblem problem;
    problem.model = placement_.problem.model;
    problem.redundant = placement_.problem.redundant;
    return problem;
  }

  // Core rows for `count` units, expected from the batches of this round or, after the first round, from the
  // smallest larger number that suffices. Sets bound_batches_ if there are any.
  std::vector<std::uint32_t> promising_rows(std::size_t count, double level) {
    const std::uint32_t max_batches = Rounds::max_batches;
    std::vector<std::uint32_t> rows;
    for (std::uint32_t batches = bound_batches_;; batches = Rounds::more(batches)) {
      control_.report(
          "proving", -1,
          fmt::format("round {}, core rows for {} units, {} batches", rounds_.round(), count, batches));
      const SignalTable expected =
          predicted_upper_rows(table_, matrix_, bound_rows_, level, signals_at_stake(), batches);
      PlaceOptions options;
      options.time_limit_s =
          rounds_.counts_samples() ? options_.place.time_limit_s : 0.1 * std::max(0.0, rounds_.left());
      options.step_limit = options_.place.step_limit;
      CoreRows decisive = core_rows(expected, count_problem(), count, options, control_);
      if (rows.empty() || decisive.suffice) rows = std::move(decisive.rows);
      if (decisive.suffice) bound_batches_ = batches;
      if (decisive.suffice || batches >= max_batches || control_.cancelled()) return rows;
    }
  }

  // Returns whether it has sampled.
  bool prove_bound(double level) {
    const auto count = static_cast<std::size_t>(placement_.count_lower_bound);
    const bool adds_up =
        placement_.problem.model == CommunicationModel::cooperative && !placement_.problem.redundant;
    if (adds_up) {
      for (std::size_t target = count; target > certificate_.count_lower_bound; --target)
        if (refute_fewer_than(target, level)) return true;
      return false;
    }
    const std::uint32_t batches = bound_batches_;
    const std::vector<std::uint32_t> rows = promising_rows(count, level);
    const double cost = expected_cost() * static_cast<double>(rows.size()) * bound_batches_;
    bound_obstacle_.clear();
    if (cost > rounds_.left()) {
      set_obstacle(count, cost);
      bound_batches_ = batches;
      return false;
    }
    const Placement fewest = fewest_for(rows, signals_at_stake(), level);
    raise_bound(std::min(fewest.count_lower_bound, static_cast<double>(count)), rows.size());
    doubtful_.clear();
    if (!bound_holds() && fewest.has_selection()) doubtful_ = worst_off(fewest.selected);
    bound_batches_ = Rounds::more(bound_batches_);
    return true;
  }

  void set_obstacle(std::size_t count, double cost) {
    bound_obstacle_ = fmt::format("proving that {} {} needed would take about {:.0f} {}", count,
                                  count == 1 ? "is" : "are", std::max(1.0, cost), rounds_.unit());
  }

  void raise_bound(double bound, std::size_t labels) {
    if (static_cast<std::size_t>(bound) > certificate_.count_lower_bound) {
      certificate_.count_lower_bound = static_cast<std::size_t>(bound);
      certificate_.bound_labels = labels;
    }
    if (bound_holds()) fresh_.clear();
  }

  // Returns whether it has tested a refutation of all selections of fewer than `count` units.
  bool refute_fewer_than(std::size_t count, double level) {
    const double begun = rounds_.spent();
    CountRefuter::Attempt attempt = refuter_.attempt(count, table_, matrix_, rounds_, level, expected_cost());
    if (!attempt.counterexample.empty()) doubtful_ = worst_off(attempt.counterexample);
    if (!attempt.is_tested) {
      if (attempt.cost > 0) set_obstacle(count, attempt.cost);
      return false;
    }
    keep(std::move(attempt.fresh), begun, attempt.labels, attempt.batches);
    if (attempt.is_proven) {
      raise_bound(static_cast<double>(count), attempt.labels);
      bound_obstacle_.clear();
    }
    return true;
  }

  // Every selection misses the labels whose upper limits are below the requirement. Returns whether it has
  // sampled.
  bool prove_unreachable(double level) {
    const std::vector<std::uint32_t> rows = open_labels();
    if (rows.empty()) return false;
    const double cost = expected_cost() * static_cast<double>(rows.size()) * bound_batches_;
    if (cost > rounds_.left()) return false;
    for (const Unreachable& label : fewest_for(rows, table_.columns(), level).unreachable) {
      LabelVerdict& verdict = certificate_.labels[rows[label.label]];
      verdict.verdict = Verdict::missed;
      verdict.upper = label.max_signal;
      verdict.samples = fresh_[label.label].samples;
    }
    for (const Unreachable& label : placement_.unreachable)
      certificate_.labels[label.label].signal = label.max_signal;
    bound_batches_ = Rounds::more(bound_batches_);
    return true;
  }

  // Labels that a selection misses on the matrix, the smallest margin first.
  std::vector<std::uint32_t> worst_off(const std::vector<std::uint32_t>& selected) const {
    const Check check = check_selection(table_, placement_.problem, selected);
    std::vector<std::uint32_t> rows = check.unmet;
    std::sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(check.signal[a] / table_.labels[a].requirement, a) <
             std::pair(check.signal[b] / table_.labels[b].requirement, b);
    });
    rows.resize(std::min(rows.size(), max_doubtful));
    return rows;
  }

  // Updates the matrix with more samples, for all candidates, of the labels that seem to be missed, and
  // solves the placement problem again: both or neither. False if nothing changes.
  bool improve() {
    std::vector<std::uint32_t> rows =
        placement_.has_selection() ? verdicts_.short_labels() : std::vector<std::uint32_t>();
    join_sets(rows, doubtful_);
    doubtful_.clear();
    const bool must_place = !rows.empty();
    if (!rows.empty()) {
      control_.report("refining", -1, fmt::format("round {}, {} labels", rounds_.round(), rows.size()));
      const double begun = rounds_.spent();
      const std::uint32_t batches = affordable_batches(rows.size());
      if (batches == 0) return false;
      const auto more = validation_rows(prepared_, rounds_.request(Purpose::refine, rows, batches), control_);
      for (const ValidationRow& row : more) rounds_.spend(row.samples);
      bound_cost_ = std::max(1e-12, (rounds_.spent() - begun) / (static_cast<double>(rows.size()) * batches));
      fresh_.insert(fresh_.end(), more.begin(), more.end());
      refine_batches_ = Rounds::more(refine_batches_);
    }
    if (fresh_.empty()) return false;
    return must_place || !placement_.has_selection() ? add_missed() : join_fresh();
  }

  // Only the matrix changes, for the next refutation: the selection is not in doubt.
  bool join_fresh() {
    joined_.emplace_back(matrix_, fresh_);
    for (const ValidationRow& row : fresh_) join(row, matrix_);
    fresh_.clear();
    table_ = rule_(matrix_);
    refuter_.forget_failures();
    return true;
  }

  // At most a third of the budget that is left; 0 if that is too little.
  std::uint32_t affordable_batches(std::size_t rows) const {
    const double each = expected_cost() * static_cast<double>(rows);
    const double most = each > 0 ? rounds_.left() / (3 * each) : refine_batches_;
    if (most < 16) return 0;
    return static_cast<std::uint32_t>(std::min<double>(refine_batches_, most));
  }

  // Keeps the update of the matrix only if a placement is found on it.
  bool add_missed() {
    RowsBefore before(matrix_, fresh_);
    for (const ValidationRow& row : fresh_) join(row, matrix_);
    SignalTable table = rule_(matrix_);
    Placement placement = place(table, placement_.problem, in_time(), control_);
    certificate_.open = infeasibility_reason(placement);
    if (!certificate_.open.empty()) {
      before.restore(matrix_);
      return false;
    }
    fresh_.clear();
    joined_.clear();
    table_ = std::move(table);
    adopt(std::move(placement));
    return true;
  }

  std::string infeasibility_reason(const Placement& placement) const {
    if (control_.cancelled()) return interrupted;
    const bool is_answer = placement.has_selection() || placement.status == Status::infeasible;
    return is_answer ? "" : "no placement was found in time after independent samples changed the matrix";
  }

  // Verdicts refer to a selection. If it stays, they stay, and open labels get more batches.
  void adopt(Placement placement) {
    const bool is_same =
        placement.selected == placement_.selected && placement.has_selection() == placement_.has_selection();
    placement.seconds += placement_.seconds;
    placement_ = std::move(placement);
    if (!is_same) forget_verdicts();
    refuter_.forget_failures();
  }

  const PreparedScene& prepared_;
  const TableRule& rule_;
  const CertifyOptions& options_;
  SignalMatrix matrix_;
  Placement placement_;
  const RunControl& control_;
  Rounds rounds_;
  SignalTable table_;
  Certificate certificate_;
  LabelRounds verdicts_;
  CountRefuter refuter_;
  std::uint32_t bound_batches_ = min_verifying_batches, refine_batches_ = min_verifying_batches;
  std::size_t bound_rows_ = max_doubtful;  ///< expected maximum number of core rows
  double bound_cost_ = 0;                  ///< per batch and label, in the budget's unit of measure
  std::string bound_obstacle_;             ///< the proof exceeds the budget; empty otherwise
  std::vector<std::uint32_t> doubtful_;
  std::vector<ValidationRow> fresh_;  ///< not yet part of the matrix
  std::vector<RowsBefore> joined_;    ///< changes of the matrix since the placement
};

}  // namespace

Certified certify(const PreparedScene& prepared, const TableRule& table, const CertifyOptions& options,
                  SignalMatrix matrix, Placement placement, const RunControl& control) {
  return Certifier(prepared, table, options, std::move(matrix), std::move(placement), control).run();
}

Certified certify(const Scene& scene, const TableRule& table, const CertifyOptions& options,
                  SignalMatrix matrix, Placement placement, const RunControl& control) {
  return certify(*prepare(scene, options.simulation, false, control), table, options, std::move(matrix),
                 std::move(placement), control);
}

}  // namespace shelfbeam
