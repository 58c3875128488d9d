#include "shelfbeam/plan/certify.hpp"

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/plan/bound_rows.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/rounds.hpp"

namespace shelfbeam {

namespace {

constexpr auto interrupted = "it was interrupted";
constexpr std::size_t max_doubtful = 64;

void join_sets(std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

class Certifier {
 public:
  Certifier(const Scene& scene, const TableRule& rule, const CertifyOptions& options, SignalMatrix matrix,
            Placement placement, const RunControl& control)
      : scene_(scene),
        rule_(rule),
        options_(options),
        matrix_(std::move(matrix)),
        placement_(std::move(placement)),
        control_(control),
        rounds_(options.confidence, options.budget, options.simulation),
        table_(rule(matrix_)),
        verdicts_(scene, certificate_.labels) {
    certificate_.confidence = options.confidence;
    forget_verdicts();
  }

  Certified run() {
    try {
      do {
        rounds_.next();
        certificate_.rounds = rounds_.round();
        // Two statements per round, on the labels and on the count, each wrong with probability at most a_r /
        // 2, where a_r = (1 - c) / 2^r. So some statement of some round is wrong with probability at most
        // sum_r a_r = 1 - c, whatever their dependence (Bonferroni).
        const double level = rounds_.level(2);
        if (!placement_.has_selection()) {
          prove_unreachable(level);
        } else {
          verify_labels(level);
          if (!bound_holds()) prove_bound(level);
        }
      } while (!is_done() && should_continue() && improve());
    } catch (const Interrupted&) {
      certificate_.open = interrupted;
    }
    certificate_.seconds = rounds_.seconds();
    return {std::move(matrix_), std::move(placement_), std::move(certificate_)};
  }

 private:
  void forget_verdicts() {
    certificate_.labels.assign(matrix_.rows(), {});
    for (std::size_t i = 0; i < matrix_.rows(); ++i)
      certificate_.labels[i].requirement = matrix_.labels[i].requirement;
  }

  bool bound_holds() const {
    return placement_.has_selection()
               ? static_cast<double>(certificate_.count_lower_bound) >= placement_.count_lower_bound
               : certificate_.count(Verdict::missed) > 0;
  }
  bool is_done() const {
    return bound_holds() && (!placement_.has_selection() || certificate_.all_reached());
  }

  std::vector<std::uint32_t> open_labels() const {
    std::vector<std::uint32_t> rows;
    if (placement_.has_selection()) {
      for (std::uint32_t i = 0; i < certificate_.labels.size(); ++i)
        if (certificate_.labels[i].verdict != Verdict::reached) rows.push_back(i);
    } else {
      for (const Unreachable& label : placement_.unreachable) rows.push_back(label.label);
      rows.resize(std::min(rows.size(), max_doubtful));
    }
    return rows;
  }

  PlaceOptions in_time() const {
    PlaceOptions options = options_.place;
    if (rounds_.counts_samples()) return options;
    options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, rounds_.left()));
    return options;
  }

  // Labels reached by the same selection in an earlier round keep their verdict.
  void verify_labels(double level) {
    const std::vector<std::uint32_t> rows = open_labels();
    if (rows.empty()) return;
    std::vector<float> planned;
    for (const std::uint32_t i : rows)
      for (const std::uint32_t j : placement_.selected) planned.push_back(matrix_.mean[matrix_.at(i, j)]);
    verdicts_.verify(rows, placement_.selected, placement_.problem, planned, rounds_, level, control_);
  }

  // The placement that upper confidence limits of some labels' signals require. The batches are kept: if they
  // do not prove the bound, they update the matrix.
  Placement fewest_for(const std::vector<std::uint32_t>& rows, double level) {
    control_.report(
        "proving", -1,
        fmt::format("round {}, {} labels, {} batches", rounds_.round(), rows.size(), bound_batches_));
    const double begun = rounds_.spent();
    UpperConfidenceRows optimistic = upper_confidence_rows(
        scene_, table_, rows, level, rounds_.effort(Purpose::bound, bound_batches_), control_);
    PlaceOptions options = in_time();
    options.settles_ties = false;
    Placement fewest = place(optimistic.table, count_problem(), options, control_);
    for (const ValidationRow& row : optimistic.fresh) rounds_.spend(row.samples);
    bound_cost_ = (rounds_.spent() - begun) / (static_cast<double>(rows.size()) * bound_batches_);
    bound_rows_ = std::max(bound_rows_, rows.size());
    fresh_ = std::move(optimistic.fresh);
    return fewest;
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
    const std::uint32_t max_batches = rounds_.round() == 1 ? bound_batches_ : Rounds::max_batches;
    std::vector<std::uint32_t> rows;
    for (std::uint32_t batches = bound_batches_;; batches = Rounds::more(batches)) {
      control_.report(
          "proving", -1,
          fmt::format("round {}, core rows for {} units, {} batches", rounds_.round(), count, batches));
      const SignalTable expected = predicted_upper_rows(table_, matrix_, bound_rows_, level, batches);
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

  void prove_bound(double level) {
    const auto count = static_cast<std::size_t>(placement_.count_lower_bound);
    const std::uint32_t batches = bound_batches_;
    const std::vector<std::uint32_t> rows = promising_rows(count, level);
    const double cost = bound_cost_ * static_cast<double>(rows.size()) * bound_batches_;
    bound_obstacle_.clear();
    if (cost > rounds_.left()) {
      bound_obstacle_ = fmt::format("proving that {} {} needed would take about {:.0f} {}", count,
                                    count == 1 ? "is" : "are", cost, rounds_.unit());
      bound_batches_ = batches;
      return;
    }
    const Placement fewest = fewest_for(rows, level);
    const double bound = std::min(fewest.count_lower_bound, static_cast<double>(count));
    if (static_cast<std::size_t>(bound) > certificate_.count_lower_bound) {
      certificate_.count_lower_bound = static_cast<std::size_t>(bound);
      certificate_.bound_labels = rows.size();
    }
    doubtful_.clear();
    if (bound_holds())
      fresh_.clear();
    else if (fewest.has_selection())
      doubtful_ = worst_off(fewest.selected);
  }

  // Every selection misses the labels whose upper limits are below the requirement.
  void prove_unreachable(double level) {
    const std::vector<std::uint32_t> rows = open_labels();
    if (rows.empty()) return;
    for (const Unreachable& label : fewest_for(rows, level).unreachable) {
      LabelVerdict& verdict = certificate_.labels[rows[label.label]];
      verdict.verdict = Verdict::missed;
      verdict.upper = label.max_signal;
      verdict.samples = fresh_[label.label].samples;
    }
    for (const Unreachable& label : placement_.unreachable)
      certificate_.labels[label.label].signal = label.max_signal;
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

  // Whether another round is worth its time; otherwise sets the reason.
  bool should_continue() {
    certificate_.open = control_.cancelled() ? interrupted : no_refinement_reason();
    return certificate_.open.empty();
  }

  std::string no_refinement_reason() const {
    const bool labels_are_open = placement_.has_selection() && !certificate_.all_reached();
    if (!placement_.has_selection() && open_labels().empty())
      return "each label can be reached alone, but conflicts prevent a selection that reaches all labels";
    if (!labels_are_open && !bound_obstacle_.empty()) return bound_obstacle_;
    if (!bound_holds() && bound_batches_ == Rounds::max_batches)
      return "signals are too close to requirements for a proof";
    const double bound_cost =
        bound_holds() || !bound_obstacle_.empty()
            ? 0
            : bound_cost_ * static_cast<double>(bound_rows_) * Rounds::more(bound_batches_);
    return stop_reason(rounds_, verdicts_, bound_cost + (labels_are_open ? verdicts_.cost_of_next() : 0));
  }

  // Updates the matrix with more samples of the open labels and solves the placement problem again: both or
  // neither.
  bool improve() {
    std::vector<std::uint32_t> rows = open_labels();
    join_sets(rows, doubtful_);
    if (!rows.empty()) {
      control_.report("refining", -1, fmt::format("round {}, {} labels", rounds_.round(), rows.size()));
      const auto more = validation_rows(
          scene_, rows, rounds_.effort(Purpose::refine, Rounds::more(verdicts_.batches())), control_);
      for (const ValidationRow& row : more) rounds_.spend(row.samples);
      fresh_.insert(fresh_.end(), more.begin(), more.end());
    }
    if (!fresh_.empty() && !add_missed()) return false;
    if (!bound_holds() && bound_obstacle_.empty()) bound_batches_ = Rounds::more(bound_batches_);
    return true;
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
    if (placement.selected == placement_.selected && placement.has_selection() == placement_.has_selection())
      verdicts_.grow();
    else
      forget_verdicts();
    placement.seconds += placement_.seconds;
    placement_ = std::move(placement);
  }

  const Scene& scene_;
  const TableRule& rule_;
  const CertifyOptions& options_;
  SignalMatrix matrix_;
  Placement placement_;
  const RunControl& control_;
  Rounds rounds_;
  SignalTable table_;
  Certificate certificate_;
  LabelRounds verdicts_;
  std::uint32_t bound_batches_ = min_verifying_batches;
  std::size_t bound_rows_ = max_doubtful;  ///< expected maximum number of core rows
  double bound_cost_ = 0;                  ///< per batch and label, in the budget's unit of measure
  std::string bound_obstacle_;             ///< the proof exceeds the budget; empty otherwise
  std::vector<std::uint32_t> doubtful_;
  std::vector<ValidationRow> fresh_;  ///< not yet part of the matrix
};

}  // namespace

Certified certify(const Scene& scene, const TableRule& table, const CertifyOptions& options,
                  SignalMatrix matrix, Placement placement, const RunControl& control) {
  return Certifier(scene, table, options, std::move(matrix), std::move(placement), control).run();
}

}  // namespace shelfbeam
