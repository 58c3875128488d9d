#include "shelfbeam/plan/certify.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/plan/bound_rounds.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/rounds.hpp"

namespace shelfbeam {

namespace {

constexpr auto interrupted = "it was interrupted";
constexpr double rounding = 1e-9;  ///< of sums of prices, relative
constexpr std::uint32_t max_certificate_rounds = 30;
constexpr std::uint32_t min_refining_batches = 16;
// Shares of the time limit of a placement.
constexpr double share_of_quick = 0.1, share_of_again = 0.1;
constexpr double share_of_sharpening = 0.2;  ///< of the budget
// Sharpening: rounds, errors by which signals may be higher, or lower, than their means, and margins of a
// selection, the widest first.
constexpr int max_sharpenings = 8;
constexpr std::size_t sharpening_batches = 4096;  ///< of all labels together
constexpr double errors_of_hope = 0.5, errors_at_risk = 1, errors_undecided = 2;
constexpr double margins_to_try[] = {0.04, 0.02, 0.01, 0.005, 0};

void join_sets(std::vector<std::uint32_t>& rows, const std::vector<std::uint32_t>& more) {
  rows.insert(rows.end(), more.begin(), more.end());
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

// The certified quantity: the sum of prices where these are minimised, and otherwise the count.
double cost_of(const Placement& placement) {
  return minimises_cost(placement.problem) ? placement.objective_value
                                           : static_cast<double>(placement.count());
}

bool is_better(const Placement& one, const Placement& other) {
  if (!one.has_selection() || !other.has_selection()) return one.has_selection() && !other.has_selection();
  return cost_of(one) < cost_of(other) * (1 - rounding);
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
        bound_(prepared, options.place, control, certificate_) {
    certificate_.confidence = options.confidence;
    aim();
  }

  Certified run() {
    try {
      if (placement_.status == Status::stopped && placement_.gap() > 0) sharpen();
      while (!is_done() && rounds_.round() < max_certificate_rounds && run_round()) {
      }
      if (certificate_.open.empty()) certificate_.open = is_done() ? unproven_bound() : reason_to_stop();
    } catch (const Interrupted&) {
      certificate_.open = interrupted;
    }
    restore();
    return_to_kept();
    // No selection has to cost more than one that reaches all labels.
    if (!placement_.has_selection() || certificate_.all_reached())
      certificate_.limit_bounds(placement_.count(), cost_of(placement_));
    certificate_.seconds = rounds_.seconds();
    return {std::move(matrix_), std::move(placement_), std::move(certificate_)};
  }

 private:
  // A search that stopped leaves a gap, which may be due to errors of the signals, and a selection that may
  // just suffice. Looks for a cheap selection with some margin, and samples the labels that decide on it.
  // Returns whether the placement may have changed.
  bool sharpen() {
    const double end = rounds_.left() * (1 - share_of_sharpening);
    const auto may_continue = [&] { return rounds_.left() > end && !control_.cancelled(); };
    std::vector<std::uint32_t> best = placement_.selected;
    bool has_sampled = false;
    for (int k = 0; k < max_sharpenings && may_continue(); ++k) {
      best = promising_selection(best);
      const std::vector<std::uint32_t> rows = worst_off(shifted(-errors_at_risk), best);
      if (rows.empty()) break;
      const auto batches = static_cast<std::uint32_t>(sharpening_batches / rows.size());
      if (!refine(rows, std::max(min_verifying_batches, batches))) break;
      join_fresh();
      has_sampled = true;
    }
    return (has_sampled || best != placement_.selected) && place_again(best);
  }

  // The cheapest selection that quick searches find on raised signals, `best` included, or one of this value
  // with a larger margin.
  std::vector<std::uint32_t> promising_selection(const std::vector<std::uint32_t>& best) {
    const Placement cheapest = quick_placement(shifted(errors_of_hope), best);
    if (!cheapest.has_selection()) return best;
    for (const double margin : margins_to_try) {
      if (rounds_.left() <= 0) break;
      SignalTable demanding = table_;
      for (SignalEntry& entry : demanding.entries) entry.signal /= 1 + margin;
      const Placement wide = quick_placement(demanding, cheapest.selected);
      if (wide.has_selection() && !is_better(cheapest, wide)) return wide.selected;
    }
    return cheapest.selected;
  }

  Placement quick_placement(const SignalTable& table, const std::vector<std::uint32_t>& start) {
    PlaceOptions options = in_time(share_of_quick);
    options.start = start;
    options.solver = SolverChoice::search;
    options.proves = options.settles_ties = false;
    return place(table, placement_.problem, options, control_);
  }

  // Signals raised by some of their standard errors (negative: lowered).
  SignalTable shifted(double errors) const { return raised_table(table_, matrix_, 0, 1, errors); }

  // Returns whether another round can add something; otherwise sets the reason.
  bool run_round() {
    rounds_.next();
    certificate_.rounds = rounds_.round();
    certificate_.open.clear();
    // Two statements per round, on the labels and on the count, each wrong with probability at most a_r / 2,
    // where a_r = (1 - c) / 2^r. So some statement of some round is wrong with probability at most sum_r a_r
    // = 1 - c, for any dependence between them (Bonferroni).
    const double level = rounds_.level(2);
    bool has_worked = false;
    if (!placement_.has_selection()) {
      has_worked = prove_unreachable(level);
    } else {
      has_worked = verdicts_.verify(rounds_, level, control_) > 0;
      if (!bound_.holds() && bound_.prove(table_, matrix_, rounds_, level, verdicts_.cost()))
        has_worked = true;
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
                                   : rounds_.stop_reason("labels are too close to their requirements");
    if (!certificate_.all_reached()) return verdicts_.obstacle(rounds_);
    if (!bound_.obstacle().empty()) return bound_.obstacle();
    return rounds_.stop_reason("signals are too close to requirements for a proof");
  }

  // The goal holds, but the search has proven no more than it.
  std::string unproven_bound() const {
    const bool is_minimum = bound_.is_tight() || is_proven(placement_);
    return is_minimum ? "" : "the search proved no larger lower bound on the simulated signals";
  }

  // Verdicts and bound refer to the placement.
  void aim() {
    certificate_.labels.assign(matrix_.rows(), {});
    for (std::size_t i = 0; i < matrix_.rows(); ++i)
      certificate_.labels[i].requirement = matrix_.labels[i].requirement;
    std::vector<float> planned;
    for (std::size_t i = 0; i < matrix_.rows(); ++i)
      for (const std::uint32_t j : placement_.selected) planned.push_back(matrix_.mean[matrix_.at(i, j)]);
    verdicts_.select(placement_.problem, placement_.selected, std::move(planned), false);
    if (placement_.has_selection()) bound_.aim(table_, placement_);
  }

  bool is_done() const {
    if (kept_ && is_proven(kept_->placement)) return true;
    if (!placement_.has_selection()) return certificate_.count(Verdict::missed) > 0;
    return bound_.holds() && certificate_.all_reached();
  }

  // Without a selection: labels that no selection seems to reach.
  std::vector<std::uint32_t> open_labels() const {
    std::vector<std::uint32_t> rows;
    for (const Unreachable& label : placement_.unreachable) rows.push_back(label.label);
    rows.resize(std::min(rows.size(), BoundRounds::max_undecided));
    std::sort(rows.begin(), rows.end());
    return rows;
  }

  // A placement that was proven optimal may use its whole time limit again.
  PlaceOptions in_time(double share) const {
    PlaceOptions options = options_.place;
    if (rounds_.counts_samples()) return options;
    if (placement_.status != Status::optimal) options.time_limit_s *= share;
    options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, rounds_.left()));
    return options;
  }

  bool prove_unreachable(double level) {
    const bool has_sampled =
        bound_.prove_unreachable(table_, open_labels(), placement_.problem, rounds_, level, verdicts_.cost());
    if (has_sampled)
      for (const Unreachable& label : placement_.unreachable)
        certificate_.labels[label.label].signal = label.max_signal;
    return has_sampled;
  }

  // Labels that a selection misses, the smallest margin first.
  std::vector<std::uint32_t> worst_off(const SignalTable& table,
                                       const std::vector<std::uint32_t>& selected) const {
    const Check check = check_selection(table, placement_.problem, selected);
    std::vector<std::uint32_t> rows = check.unmet;
    const auto share = [&](std::uint32_t i) {
      return check.signal[i] / requirement_of(table.labels[i], placement_.problem.model);
    };
    std::sort(rows.begin(), rows.end(), [&](std::uint32_t a, std::uint32_t b) {
      return std::pair(share(a), a) < std::pair(share(b), b);
    });
    rows.resize(std::min(rows.size(), BoundRounds::max_undecided));
    return rows;
  }

  bool reaches_all(const SignalTable& table, const std::vector<std::uint32_t>& selected) const {
    return check_selection(table, placement_.problem, selected).met();
  }

  // Samples, for all candidates, labels that seem to be missed, that many batches have not decided, or that
  // decide on a cheaper selection, and updates the matrix. Solves the placement problem again if the
  // selection, or one that is cheaper, has changed its status. False if nothing changes.
  bool improve() {
    std::vector<std::uint32_t> rows;
    if (placement_.has_selection()) rows = verdicts_.undecided_labels();
    const bool has_doubts = !rows.empty();
    std::vector<std::uint32_t> cheaper = bound_.take_counterexample();
    // A selection that misses labels clearly decides nothing.
    if (!cheaper.empty() && !reaches_all(shifted(errors_undecided), cheaper)) cheaper.clear();
    if (!cheaper.empty()) join_sets(rows, worst_off(table_, cheaper));
    fresh_ = bound_.take_fresh();
    if (placement_.has_selection() && bound_.holds()) fresh_.clear();
    if (!rows.empty()) refine(rows, refine_batches_);
    const bool is_cheaper = !cheaper.empty() && reaches_all(table_, cheaper);
    if (fresh_.empty() && !is_cheaper) return false;
    join_fresh();
    refine_batches_ = Rounds::more(refine_batches_);
    if (!cheaper.empty() && reaches_all(table_, cheaper)) return place_again(cheaper);
    if (!placement_.has_selection()) return place_again({});
    if (reaches_all(has_doubts ? shifted(-errors_of_hope) : table_, placement_.selected)) return true;
    return placement_.status == Status::stopped ? sharpen() : place_again(placement_.selected);
  }

  // Samples labels for all candidates. Returns whether the budget allows it: at most a third of the rest.
  bool refine(std::vector<std::uint32_t> rows, std::uint32_t wanted) {
    std::sort(rows.begin(), rows.end());
    control_.report("refining", -1, fmt::format("round {}, {} labels", rounds_.round(), rows.size()));
    const double each = bound_.cost(rounds_, verdicts_.cost()) * static_cast<double>(rows.size());
    // Before the cost is known, a few batches measure it.
    const double most = each > 0 ? rounds_.left() / (3 * each) : min_refining_batches;
    if (most < min_refining_batches) return false;
    const double begun = rounds_.spent();
    const auto batches = static_cast<std::uint32_t>(std::min<double>(wanted, most));
    const auto more =
        validation_rows(prepared_, rounds_.request(Purpose::refine, rows, batches, refinements_++), control_);
    bound_.measure(more, begun, rounds_);
    fresh_.insert(fresh_.end(), more.begin(), more.end());
    return true;
  }

  void join_fresh() {
    if (fresh_.empty()) return;
    joined_.emplace_back(matrix_, fresh_);
    for (const ValidationRow& row : fresh_) join(row, matrix_);
    fresh_.clear();
    table_ = rule_(matrix_);
    bound_.forget_failures();
  }

  // The placement refers to the matrix on which it was made.
  void restore() {
    if (joined_.empty()) return;
    for (; !joined_.empty(); joined_.pop_back()) joined_.back().restore(matrix_);
    table_ = rule_(matrix_);
  }

  // Keeps the updates of the matrix only if a placement is found on it.
  bool place_again(const std::vector<std::uint32_t>& start) {
    PlaceOptions options = in_time(share_of_again);
    options.start = start;
    Placement placement = place(table_, placement_.problem, options, control_);
    certificate_.open = infeasibility_reason(placement);
    if (!certificate_.open.empty()) {
      restore();
      return false;
    }
    keep();
    adopt(std::move(placement));
    return true;
  }

  // Keeps the present placement if its selection reaches all labels and no kept one is cheaper, and the
  // changes of the matrix since the kept placement.
  void keep() {
    if (placement_.has_selection() && certificate_.all_reached() &&
        !(kept_ && is_better(kept_->placement, placement_)))
      kept_ = Kept{placement_, certificate_.labels, {}};
    if (kept_) std::move(joined_.begin(), joined_.end(), std::back_inserter(kept_->changes));
    joined_.clear();
  }

  // Returns to the kept placement if the last one has open labels or costs more.
  void return_to_kept() {
    if (!kept_ || (certificate_.all_reached() && !is_better(kept_->placement, placement_))) return;
    for (; !kept_->changes.empty(); kept_->changes.pop_back()) kept_->changes.back().restore(matrix_);
    kept_->placement.seconds = placement_.seconds;
    placement_ = std::move(kept_->placement);
    certificate_.labels = std::move(kept_->labels);
    if (is_proven(placement_))
      certificate_.open.clear();
    else if (certificate_.open != interrupted)
      certificate_.open = fmt::format("it is undecided whether a cheaper selection reaches all labels{}{}",
                                      certificate_.open.empty() ? "" : "; ", certificate_.open);
  }

  // Whether no selection costs less, which needs no search if this one reaches all labels.
  bool is_proven(const Placement& placement) const {
    const double bound = minimises_cost(placement.problem)
                             ? certificate_.cost_lower_bound
                             : static_cast<double>(certificate_.count_lower_bound);
    return bound >= cost_of(placement) * (1 - rounding);
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
    if (!is_same)
      aim();
    else if (placement_.has_selection())
      bound_.aim(table_, placement_);
  }

  struct Kept {
    Placement placement;
    std::vector<LabelVerdict> labels;
    std::vector<RowsBefore> changes;  ///< of the matrix, since the placement
  };

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
  BoundRounds bound_;
  std::uint32_t refine_batches_ = min_verifying_batches, refinements_ = 0;
  std::vector<ValidationRow> fresh_;  ///< not yet part of the matrix
  std::vector<RowsBefore> joined_;    ///< changes of the matrix since the placement
  std::optional<Kept> kept_;
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
