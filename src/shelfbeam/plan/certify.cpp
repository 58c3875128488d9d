#include "shelfbeam/plan/certify.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/plan/bound_rounds.hpp"
#include "shelfbeam/plan/question/question_key.hpp"
#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/rounds.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

namespace shelfbeam {

namespace {

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

// The certified quantity: the sum of prices where these are minimised, and otherwise the count.
double cost_of(const Placement& placement) {
  return minimises_cost(placement.problem) ? placement.objective_value
                                           : static_cast<double>(placement.count());
}

bool is_better(const Placement& one, const Placement& other) {
  if (!one.has_selection() || !other.has_selection()) return one.has_selection() && !other.has_selection();
  return cost_of(one) < cost_of(other) * (1 - rounding);
}

// A placement, with the matrix on which it was made.
struct Attempt {
  std::shared_ptr<SignalMatrix> matrix;
  Placement placement;
  std::vector<LabelVerdict> labels = {};
};

class Certifier {
 public:
  Certifier(const PreparedScene& prepared, const TableRule& rule, const CertifyOptions& options,
            SignalMatrix matrix, Placement placement, const RunControl& control)
      : prepared_(prepared),
        rule_(rule),
        options_(options),
        control_(control),
        rounds_(options.confidence, 2, options.budget, options.simulation.seed, control),
        now_{std::make_shared<SignalMatrix>(std::move(matrix)), std::move(placement)},
        signals_{now_.matrix, rule(*now_.matrix)},
        verdicts_(prepared.world().scene, options.simulation, certificate_.labels),
        bound_(prepared, options.place, rounds_, certificate_) {
    certificate_.confidence = options.confidence;
    aim();
  }

  Certified run() && {
    certificate_.open = Rounds::reason_after([&]() -> std::optional<EndReason> {
      if (now_.placement.status == Status::stopped && now_.placement.gap() > 0) sharpen();
      while (!is_done() && rounds_.round() < max_certificate_rounds && run_round()) {
      }
      if (certificate_.open) return certificate_.open;
      return is_done() ? unproven_bound() : reason_to_stop();
    });
    return_to_kept();
    // No selection has to cost more than one that reaches all labels.
    if (!now_.placement.has_selection() || certificate_.all_reached())
      certificate_.limit_bounds(now_.placement.count(), cost_of(now_.placement));
    certificate_.seconds = rounds_.seconds();
    return {std::move(*now_.matrix), std::move(now_.placement), std::move(certificate_)};
  }

 private:
  const PlacementProblem& problem() const { return now_.placement.problem; }

  // A search that stopped leaves a gap, which may be due to errors of the signals, and a selection that may
  // just suffice. Looks for a cheap selection with some margin, and samples the labels that decide on it.
  // Returns whether the placement may have changed.
  bool sharpen() {
    const double end = rounds_.left() * (1 - share_of_sharpening);
    const auto may_continue = [&] { return rounds_.left() > end && !control_.cancelled(); };
    Selection best = now_.placement.selected;
    bool has_sampled = false;
    for (int k = 0; k < max_sharpenings && may_continue(); ++k) {
      best = promising_selection(best);
      const std::vector<LabelId> rows = worst_off(shifted(-errors_at_risk), best);
      if (rows.empty()) break;
      const auto batches = static_cast<std::uint32_t>(sharpening_batches / rows.size());
      if (!refine(rows, std::max(min_verifying_batches, batches))) break;
      join_fresh();
      has_sampled = true;
    }
    return (has_sampled || best != now_.placement.selected) && place_again(best);
  }

  // The cheapest selection that quick searches find on raised signals, `best` included, or one of this value
  // with a larger margin.
  Selection promising_selection(const Selection& best) {
    const Placement cheapest = quick_placement(shifted(errors_of_hope), best);
    if (!cheapest.has_selection()) return best;
    for (const double margin : margins_to_try) {
      if (rounds_.left() <= 0) break;
      SignalTable demanding = signals_.table;
      for (SignalEntry& entry : demanding.entries) entry.signal /= 1 + margin;
      const Placement wide = quick_placement(demanding, cheapest.selected);
      if (wide.has_selection() && !is_better(cheapest, wide)) return wide.selected;
    }
    return cheapest.selected;
  }

  Placement quick_placement(const SignalTable& table, const Selection& start) {
    PlaceOptions options = in_time(share_of_quick);
    options.start = start;
    options.solver = SolverChoice::search;
    options.proves = options.settles_ties = false;
    return place(table, problem(), options, control_);
  }

  // Signals raised by some of their standard errors (negative: lowered).
  SignalTable shifted(double errors) const {
    return raised_table(signals_.table, *signals_.matrix, 0, 1, errors);
  }

  // Returns whether another round can add something; otherwise sets the reason.
  bool run_round() {
    rounds_.next();
    certificate_.rounds = rounds_.round();
    certificate_.open.reset();
    const bool has_selection = now_.placement.has_selection();
    bool has_worked = has_selection ? verdicts_.verify(rounds_) > 0
                                    : bound_.prove_unreachable(signals_.table, now_.placement);
    if (has_selection && !bound_.holds() && bound_.prove(signals_)) has_worked = true;
    if (is_done()) return false;
    if (control_.cancelled()) throw Interrupted("the certificate was interrupted");
    if (rounds_.left() > 0 && improve()) return true;
    if (certificate_.open) return false;
    if (has_worked && rounds_.left() > 0) return true;
    certificate_.open = reason_to_stop();
    return false;
  }

  EndReason reason_to_stop() const {
    if (!now_.placement.has_selection())
      return now_.placement.unreachable.empty() ? EndReason{EndCause::conflicts}
                                                : rounds_.stop_reason(EndCause::labels_near);
    if (!certificate_.all_reached()) return verdicts_.obstacle(rounds_);
    return bound_.obstacle().value_or(rounds_.stop_reason(EndCause::signals_near));
  }

  // The goal holds, but the search has proven no more than it.
  std::optional<EndReason> unproven_bound() const {
    if (bound_.is_tight() || is_proven(now_.placement)) return {};
    return EndReason{EndCause::weak_bound};
  }

  // Verdicts and bound refer to the placement.
  void aim() {
    const SignalMatrix& matrix = *signals_.matrix;
    const Selection& selected = now_.placement.selected;
    certificate_.labels.assign(matrix.rows(), {});
    std::vector<float> planned;
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
      certificate_.labels[i].requirement = matrix.labels[i].requirement;
      for (const std::uint32_t j : selected) planned.push_back(matrix.mean[matrix.at(i, j)]);
    }
    verdicts_.select(problem(), selected, std::move(planned), false);
    if (now_.placement.has_selection()) bound_.aim(signals_.table, now_.placement);
  }

  bool is_done() const {
    if (kept_ && is_proven(kept_->placement)) return true;
    if (!now_.placement.has_selection()) return certificate_.count(Verdict::missed) > 0;
    return bound_.holds() && certificate_.all_reached();
  }

  // A placement that was proven optimal may use its whole time limit again.
  PlaceOptions in_time(double share) const {
    PlaceOptions options = options_.place;
    if (rounds_.counts_samples()) return options;
    if (now_.placement.status != Status::optimal) options.time_limit_s *= share;
    options.time_limit_s = std::min(options.time_limit_s, std::max(1.0, rounds_.left()));
    return options;
  }

  // Labels that a selection misses, the smallest margin first.
  std::vector<LabelId> worst_off(const SignalTable& table, const Selection& selected) const {
    const Check check = check_selection(table, problem(), selected);
    std::vector<LabelId> rows = check.unmet;
    const auto share = [&](LabelId i) {
      return check.signal[i] / requirement_of(table.labels[i], problem().model);
    };
    std::sort(rows.begin(), rows.end(),
              [&](LabelId a, LabelId b) { return std::pair(share(a), a) < std::pair(share(b), b); });
    rows.resize(std::min(rows.size(), BoundRounds::max_undecided));
    return rows;
  }

  bool reaches_all(const SignalTable& table, const Selection& selected) const {
    return check_selection(table, problem(), selected).met();
  }

  // Samples, for all candidates, labels that seem to be missed, that many batches have not decided, or that
  // decide on a cheaper selection, and updates the signals. Solves the placement problem again if the
  // selection, or one that is cheaper, has changed its status. False if nothing changes.
  bool improve() {
    std::vector<LabelId> rows;
    if (now_.placement.has_selection()) rows = verdicts_.undecided_labels();
    const bool has_doubts = !rows.empty();
    Selection cheaper = bound_.take_counterexample();
    // A selection that misses labels clearly decides nothing.
    if (!cheaper.empty() && !reaches_all(shifted(errors_undecided), cheaper)) cheaper.clear();
    if (!cheaper.empty())
      for (const LabelId i : worst_off(signals_.table, cheaper)) rows.push_back(i);
    fresh_ = bound_.take_fresh();
    if (now_.placement.has_selection() && bound_.holds()) fresh_.clear();
    if (!rows.empty()) refine(rows, refine_batches_);
    const bool is_cheaper = !cheaper.empty() && reaches_all(signals_.table, cheaper);
    if (fresh_.empty() && !is_cheaper) return false;
    join_fresh();
    refine_batches_ = Rounds::more(refine_batches_);
    if (!cheaper.empty() && reaches_all(signals_.table, cheaper)) return place_again(cheaper);
    if (!now_.placement.has_selection()) return place_again({});
    if (reaches_all(has_doubts ? shifted(-errors_of_hope) : signals_.table, now_.placement.selected))
      return true;
    return now_.placement.status == Status::stopped ? sharpen() : place_again(now_.placement.selected);
  }

  // Samples labels for all candidates. Returns whether the budget allows it: at most a third of the rest.
  bool refine(std::vector<LabelId> rows, std::uint32_t wanted) {
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    rounds_.report(Task::refining, fmt::format("{} labels", rows.size()));
    const double each = rounds_.cost(TracedUnits::all) * static_cast<double>(rows.size());
    // Before the cost is known, a few batches measure it.
    const double most = each > 0 ? rounds_.left() / (3 * each) : min_refining_batches;
    if (most < min_refining_batches) return false;
    const double begun = rounds_.spent();
    const auto batches = static_cast<std::uint32_t>(std::min<double>(wanted, most));
    const auto more =
        validation_rows(prepared_, rounds_.request(Purpose::refine, rows, batches, refinements_++), control_);
    rounds_.measure(begun, more);
    fresh_.insert(fresh_.end(), more.begin(), more.end());
    return true;
  }

  void join_fresh() {
    if (fresh_.empty()) return;
    auto refined = std::make_shared<SignalMatrix>(*signals_.matrix);
    for (const ValidationRow& row : fresh_) join(row, *refined);
    fresh_.clear();
    signals_ = {refined, rule_(*refined)};
    bound_.forget_failures();
  }

  // Keeps the updates of the signals only if a placement is found on them.
  bool place_again(const Selection& start) {
    PlaceOptions options = in_time(share_of_again);
    options.start = start;
    Placement placement = place(signals_.table, problem(), options, control_);
    if (control_.cancelled())
      certificate_.open = {EndCause::interrupted};
    else if (!placement.has_selection() && placement.status != Status::infeasible)
      certificate_.open = {EndCause::no_placement};
    else
      certificate_.open.reset();
    if (certificate_.open) {
      if (signals_.matrix != now_.matrix) signals_ = {now_.matrix, rule_(*now_.matrix)};
      return false;
    }
    if (now_.placement.has_selection() && certificate_.all_reached() &&
        !(kept_ && is_better(kept_->placement, now_.placement)))
      kept_ = Attempt{now_.matrix, now_.placement, certificate_.labels};
    adopt(std::move(placement));
    return true;
  }

  // Returns to the kept placement if the last one has open labels or costs more.
  void return_to_kept() {
    if (!kept_ || (certificate_.all_reached() && !is_better(kept_->placement, now_.placement))) return;
    kept_->placement.seconds = now_.placement.seconds;
    now_ = std::move(*kept_);
    certificate_.labels = std::move(now_.labels);
    if (is_proven(now_.placement))
      certificate_.open.reset();
    else if (!certificate_.open)
      certificate_.open = {EndCause::cheaper};
    else if (certificate_.open->cause != EndCause::interrupted)
      certificate_.open->leaves_cheaper = true;
  }

  // Whether no selection costs less, which needs no search if this one reaches all labels.
  bool is_proven(const Placement& placement) const {
    const double bound = minimises_cost(placement.problem)
                             ? certificate_.cost_lower_bound
                             : static_cast<double>(certificate_.count_lower_bound);
    return bound >= cost_of(placement) * (1 - rounding);
  }

  // Verdicts refer to a selection. If it stays, they stay, and open labels get more batches.
  void adopt(Placement placement) {
    const bool is_same = placement.selected == now_.placement.selected &&
                         placement.has_selection() == now_.placement.has_selection();
    placement.seconds += now_.placement.seconds;
    now_ = {signals_.matrix, std::move(placement)};
    if (!is_same)
      aim();
    else if (now_.placement.has_selection())
      bound_.aim(signals_.table, now_.placement);
  }

  const PreparedScene& prepared_;
  const TableRule& rule_;
  const CertifyOptions& options_;
  const RunControl& control_;
  Rounds rounds_;
  Attempt now_;
  std::optional<Attempt> kept_;  ///< the best one that reaches all labels, if another is tried
  PlannedSignals signals_;       ///< refined since the placement
  Certificate certificate_;
  LabelRounds verdicts_;
  BoundRounds bound_;
  std::uint32_t refine_batches_ = min_verifying_batches, refinements_ = 0;
  std::vector<ValidationRow> fresh_;  ///< not yet part of the signals
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

CertifiedPlan verify_installation(const Scene& scene, const PlacementProblem& problem,
                                  const CertifyOptions& options, const RunControl& control) {
  // The signals that plan the links; sums need no plan.
  std::vector<float> planned;
  if (problem.model == CommunicationModel::non_cooperative)
    planned = simulate(scene, options.simulation, control).matrix.mean;
  CertifiedPlan plan;
  Placement& placement = plan.placement;
  // These units are mounted, so no objective chooses them.
  placement.problem.model = problem.model;
  placement.problem.redundant = problem.redundant;
  placement.selected = all_numbers<ColumnId>(scene.transceivers.size());
  placement.objective_value = static_cast<double>(placement.count());
  Certificate& certificate = plan.certificate.emplace();
  certificate.confidence = options.confidence;
  for (const Label& label : scene.labels)
    certificate.labels.push_back({.requirement = scene.requirement_of(label)});
  SimulationOptions fresh = options.simulation;
  fresh.seed = question_key(options.simulation.seed, scene, problem);
  Rounds rounds(options.confidence, 1, options.budget, fresh.seed, control);
  LabelRounds verdicts(scene, fresh, certificate.labels);
  verdicts.select(problem, placement.selected, std::move(planned), true);
  certificate.open = Rounds::reason_after([&]() -> std::optional<EndReason> {
    while (certificate.count(Verdict::undecided) > 0) {
      rounds.next();
      if (verdicts.verify(rounds) == 0) return verdicts.obstacle(rounds);
      certificate.rounds = rounds.round();
    }
    return {};
  });
  certificate.seconds = rounds.seconds();
  certificate.mark_unverified();
  return plan;
}

}  // namespace shelfbeam
