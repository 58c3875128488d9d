#include "shelfbeam/placement/coverage/budget.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/coverage/reach_bound.hpp"
#include "shelfbeam/placement/coverage/reach_search.hpp"
#include "shelfbeam/placement/mip/cover_model.hpp"
#include "shelfbeam/placement/mip/export_model.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

namespace shelfbeam {

namespace {

using Clock = std::chrono::steady_clock;

// Entries looked at, so that answers do not depend on the machine: about ten seconds each.
constexpr std::size_t search_work = 2'000'000'000;
constexpr std::size_t bound_work = 4'000'000'000;

constexpr std::size_t most_entries = 400'000;

bool fails_by_rows(const Question& question) {
  return question.redundant && question.model == CommunicationModel::cooperative;
}

/// The most labels that at most `units` units reach, as a MIP: the rows of CoverModel with a variable u_i
/// that pays for label i when it is missed; u_i costs more than all units together, so that the fewest labels
/// are missed first and fewest units are used second.
class ReachModel {
 public:
  /// False where the model would be too large to be solved to the end.
  static bool fits(const SignalTable& table, const Question& question) {
    std::size_t entries = table.entries.size();
    if (fails_by_rows(question))
      for (std::size_t i = 0; i < table.rows(); ++i) entries += table.row(i).size() * table.row(i).size();
    return entries <= most_entries;
  }

  ReachModel(const SignalTable& table, const Question& question, std::size_t units)
      : table_(table), question_(question), units_(units) {
    question_.objective = Objective::count;
    question_.combination = Combination::lexicographic;
    model_ = model_without_failures(table, question_);
    // A label that needs one unit or none is missed by as much as its row lacks; the others wholly or not.
    const bool whole = question.redundant || question.model == CommunicationModel::cooperative;
    const auto price = static_cast<double>(table.columns() + 1);
    for (std::size_t i = 0; i < table.rows(); ++i)
      model_.columns.push_back({price, 0, 1, whole, "missed_" + table.labels[i].id});
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const auto missed = static_cast<std::uint32_t>(table.columns() + i);
      milp::Row& row = model_.rows[i];
      if (question.model == CommunicationModel::cooperative) row = detail::relaxed(std::move(row));
      row.entries.push_back({missed, question.redundant && !fails_by_rows(question) ? 2.0 : 1.0});
      if (!fails_by_rows(question)) continue;
      for (const SignalEntry& entry : table.row(i)) {
        model_.rows.push_back(detail::relaxed(failure_row(table, i, entry.transceiver)));
        model_.rows.back().entries.push_back({missed, 1.0});
      }
    }
    milp::Row count{-milp::infinity, static_cast<double>(units), {}, "units"};
    for (std::uint32_t j = 0; j < table.columns(); ++j) count.entries.push_back({j, 1.0});
    model_.rows.push_back(std::move(count));
  }

  struct Outcome {
    std::optional<std::vector<std::uint32_t>> selected;  ///< allowed, of at most `units` units
    std::size_t most_reached = 0;                        ///< no selection reaches more
    bool failed = false;  ///< the solver failed or contradicted itself; `most_reached` can still be relied on
  };
  Outcome solve(const SolveFunction& solve, double time_limit_s, const RunControl& control) {
    const Deadline deadline(time_limit_s);
    Outcome outcome;
    outcome.most_reached = table_.rows();
    const auto price = static_cast<double>(table_.columns() + 1);
    while (!deadline.has_passed() && !control.cancelled()) {
      const milp::Result result = solve(model_, {.time_limit_s = deadline.seconds_left()}, control);
      const bool empty_handed = result.solution.empty() && !model_.columns.empty();
      const bool wrong =
          !empty_handed && milp::violation(model_, result.solution) > milp::feasibility_tolerance;
      // Nothing is infeasible here: the installed units alone are a selection.
      if (wrong || result.termination == milp::Termination::error ||
          result.termination == milp::Termination::infeasible) {
        outcome.failed = true;
        break;
      }
      // The value is count + price missed, and count <= units < price.
      const double missed = std::ceil((result.dual_bound - static_cast<double>(units_)) / price - 1e-6);
      if (missed > 0)
        outcome.most_reached = std::min(
            outcome.most_reached, table_.rows() - std::min(table_.rows(), static_cast<std::size_t>(missed)));
      if (empty_handed) break;
      std::vector<std::uint32_t> selected;
      for (std::uint32_t j = 0; j < table_.columns(); ++j)
        if (result.solution[j] > 0.5) selected.push_back(j);
      const Check check = check_selection(table_, question_, selected);
      if (!check.allowed() || selected.size() > units_) {
        outcome.failed = true;
        break;
      }
      outcome.selected = selected;
      if (result.termination != milp::Termination::optimal) break;
      bool mistaken = false;
      for (const std::uint32_t i : check.unmet) {
        if (result.solution[table_.columns() + i] > 0.5) continue;
        cut_off(selected, i);
        mistaken = true;
      }
      if (!mistaken) break;
    }
    return outcome;
  }

 private:
  // As CoverModel's cut: the selection leaves the label unmet, so it is missed or one of the others is
  // chosen.
  void cut_off(const std::vector<std::uint32_t>& selected, std::size_t unmet_label) {
    milp::Row cut{1.0, milp::infinity, {}, "cut"};
    for (std::uint32_t j = 0; j < table_.columns(); ++j)
      if (!std::binary_search(selected.begin(), selected.end(), j)) cut.entries.push_back({j, 1.0});
    cut.entries.push_back({static_cast<std::uint32_t>(table_.columns() + unmet_label), 1.0});
    model_.rows.push_back(std::move(cut));
  }

  const SignalTable& table_;
  Question question_;
  std::size_t units_;
  milp::Model model_;
};

/// Takes a selection that is better than the one so far.
void offer(Reach& reach, const SignalTable& table, const std::vector<std::uint32_t>& selected) {
  Check check = check_selection(table, reach.question, selected);
  const std::size_t reached = table.rows() - check.unmet.size();
  const bool better =
      reached > reach.reached || (reached == reach.reached && selected.size() < reach.selected.size());
  if (!check.allowed() || selected.size() > reach.at_most || !better) return;
  reach.selected = selected;
  reach.reached = reached;
  reach.missed = std::move(check.unmet);
}

}  // namespace

Reach reach_most(const SignalTable& table, const Question& question, std::size_t units,
                 const PlaceOptions& options, const RunControl& control) {
  const auto start = Clock::now();
  constexpr double endless_s = 1e8;
  const double limit_s = options.step_limit ? endless_s : options.time_limit_s;
  check_question(table, question);
  const auto backends = milp::wanted_backends(options.backend);

  Reach reach;
  reach.question = question;
  reach.at_most = units;
  reach.solver = "greedy";
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed) reach.selected.push_back(j);
  if (reach.selected.size() > units)
    throw InputError("number of units",
                     fmt::format("is {}, and {} units are installed already", units, reach.selected.size()),
                     "allow at least these", Setting::units);
  units = std::min(units, table.columns());
  reach.missed = check_selection(table, question, reach.selected).unmet;
  reach.reached = table.rows() - reach.missed.size();

  const bool may_ask = options.solver == SolverChoice::automatic || options.solver == SolverChoice::mip;
  const bool fits = ReachModel::fits(table, question);
  const bool is_asked = may_ask && fits;
  reach.too_large = may_ask && !fits;
  const Deadline search_end((is_asked ? 0.3 : 0.5) * limit_s), bound_end((is_asked ? 0.5 : 1) * limit_s),
      end(limit_s);

  detail::ReachSearch search(table, question);
  search.improve(units, search_work, control, search_end.end());
  offer(reach, table, search.selected());

  ReachBound bound(table, question, units);
  const auto lower_to = [&](std::size_t most, BoundProof proof) {
    if (most >= reach.upper_bound) return;
    reach.upper_bound = most;
    reach.bound_proof = proof;
  };
  reach.upper_bound = bound.labels(units);
  bound.improve(units, reach.reached, std::min<std::size_t>(1000, 1 + bound_work / (2 * bound.entries() + 1)),
                control, bound_end.end());
  lower_to(bound.labels(units), BoundProof::dual);

  if (is_asked)
    for (const milp::Backend& backend : backends) {
      ReachModel model(table, question, units);
      const auto outcome =
          model.solve(limited(backend.solve, options.step_limit), end.seconds_left(), control);
      reach.solver = fmt::format("{} {}", backend.name, backend.version);
      lower_to(outcome.most_reached, BoundProof::solver);
      if (outcome.selected) offer(reach, table, *outcome.selected);
      if (!outcome.failed) break;
    }
  const bool was_cut_short = control.cancelled() || end.has_passed();
  reach.status = reach.upper_bound <= reach.reached ? Status::optimal
                 : is_asked || was_cut_short        ? Status::stopped
                                                    : Status::feasible;
  reach.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return reach;
}

}  // namespace shelfbeam
