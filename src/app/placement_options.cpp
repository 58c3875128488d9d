#include "placement_options.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/scenarios.hpp"

#include "arguments.hpp"
#include "verbs.hpp"

namespace shelfbeam::app {

Question QuestionFlags::question() const {
  Question question;
  question.model =
      model == "cooperative" ? CommunicationModel::cooperative : CommunicationModel::non_cooperative;
  question.objective = objective == "count"    ? Objective::count
                       : objective == "links"  ? Objective::links
                       : objective == "signal" ? Objective::signal
                                               : Objective::effective_links;
  question.combination = weighted ? Combination::weighted : Combination::lexicographic;
  question.share = share;
  question.redundant = survive_failure;
  return question;
}

PlaceOptions SolverFlags::options() const {
  PlaceOptions options;
  options.solver = solver == "auto"  ? SolverChoice::automatic
                   : solver == "mip" ? SolverChoice::mip
                                     : SolverChoice::greedy;
  options.backend = backend;
  options.time_limit_s = time_limit_s;
  return options;
}

void add_question_options(CLI::App& verb, QuestionFlags& flags) {
  verb.add_option("--model", flags.model, "cooperative: signals add up; non-cooperative: one unit must do")
      ->check(CLI::IsMember({"cooperative", "non-cooperative"}))
      ->capture_default_str();
  verb.add_option("--objective", flags.objective, "What to minimise beside the number of transceivers")
      ->check(CLI::IsMember({"count", "links", "effective-links", "signal"}))
      ->capture_default_str();
  auto* weighted =
      verb.add_flag("--weighted", flags.weighted, "Minimise the cost of units plus the objective");
  verb.add_flag("--lexicographic", flags.lexicographic,
                "Fewest transceivers first, then the objective (default)")
      ->excludes(weighted);
  verb.add_option("--share", flags.share, "Share of the requirement from which an effective link counts")
      ->check(positive_number())
      ->capture_default_str();
  verb.add_flag("--survive-failure", flags.survive_failure,
                "Every label stays reached when any one unit fails, installed ones included");
}

void add_solver_options(CLI::App& verb, SolverFlags& flags, double default_time_limit_s) {
  flags.time_limit_s = default_time_limit_s;
  std::vector<std::string> names;
  for (const milp::Backend& backend : milp::backends()) names.emplace_back(backend.name);
  verb.add_option("--solver", flags.solver, "auto, mip (exact) or greedy (the paper's heuristic)")
      ->check(CLI::IsMember({"auto", "mip", "greedy"}))
      ->capture_default_str();
  verb.add_option("--backend", flags.backend, fmt::format("MIP solver: {}", fmt::join(names, " or ")))
      ->check(CLI::IsMember(names));
  verb.add_option("--time-limit", flags.time_limit_s, "Seconds for the solver")
      ->check(positive_number())
      ->capture_default_str();
}

namespace {

std::string why_exclusive(const SignalTable& table) {
  if (table.apart.empty()) return "a mounting point holds one unit";
  return table.mounts.empty() ? "some pairs must not be chosen together"
                              : "a mounting point holds one unit and some pairs must not be chosen together";
}

std::string describe_infeasible(const Placement& placement, const SignalTable& table) {
  const std::size_t labels = table.rows();
  const bool redundant = placement.question.redundant;
  if (placement.unreachable.empty())
    return fmt::format(
        "No selection reaches all {} labels{}: each could be reached, but not all of them at once, because "
        "{} "
        "(proven by {}).\n",
        labels, redundant ? " whichever unit fails" : "", why_exclusive(table), placement.solver);
  const char* const all =
      table.mounts.empty() ? "all candidates together" : "the best options of all mounting points together";
  const std::string best = placement.question.model == CommunicationModel::non_cooperative
                               ? (redundant ? "the second best candidate" : "the best candidate")
                               : fmt::format("{}{}", all, redundant ? " when the strongest fails" : "");
  std::string text = fmt::format("No selection reaches all {} labels: {} cannot be reached even by {}.\n",
                                 labels, placement.unreachable.size(), best);
  const std::size_t shown = std::min<std::size_t>(10, placement.unreachable.size());
  for (std::size_t u = 0; u < shown; ++u) {
    const Unreachable& one = placement.unreachable[u];
    text += fmt::format("  {}: at most {:.4g}, needs {:.4g}{}\n", table.labels[one.label].id, one.most,
                        one.requirement,
                        one.most == 0 ? " (no light arrives at all: is it inside something?)" : "");
  }
  if (shown < placement.unreachable.size())
    text += fmt::format("  and {} more\n", placement.unreachable.size() - shown);
  return text;
}

}  // namespace

namespace {

const char* behind_bound(BoundProof proof) {
  switch (proof) {
    case BoundProof::trivial:
      return "what is plain without a search";
    case BoundProof::dual:
      return "a dual solution, added up again from the matrix";
    case BoundProof::log:
      return "exhaustive search, its log checked";
    case BoundProof::search:
      return "exhaustive search, its log too long to be checked";
    case BoundProof::solver:
      return "the word of a MIP solver";
  }
  return "";
}

}  // namespace

std::string describe(const Placement& placement, const SignalTable& table) {
  const bool cooperative = placement.question.model == CommunicationModel::cooperative;
  const std::size_t labels = table.rows();
  if (placement.status == Status::infeasible) return describe_infeasible(placement, table);
  if (placement.selected.empty() && placement.status == Status::stopped && placement.solver == "greedy")
    return fmt::format(
        "The greedy method found no placement; at least {} transceivers are needed. '--solver mip' searches "
        "for one.\n",
        placement.count_lower_bound);
  if (placement.selected.empty() && placement.status == Status::stopped)
    return fmt::format("No placement was found in time; at least {} transceivers are needed.\n",
                       placement.count_lower_bound);
  std::string text = fmt::format(
      "{} reach{} all {} labels ({}); ",
      placement.count() == 1 ? "1 transceiver" : fmt::format("{} transceivers", placement.count()),
      placement.count() == 1 ? "es" : "", labels,
      fmt::format("{}{}", cooperative ? "cooperative" : "non-cooperative",
                  placement.question.redundant ? ", whichever unit fails" : ""));
  if (static_cast<double>(placement.count()) <= placement.count_lower_bound)
    text += "fewer cannot, proven.\n";
  else
    text += fmt::format("at least {} are needed.\n", placement.count_lower_bound);
  std::vector<std::string_view> ids;
  for (const std::uint32_t j : placement.selected) ids.push_back(table.transceivers[j].id);
  text += fmt::format("  chosen: {}\n", fmt::join(ids, ", "));
  if (!table.mounts.empty())
    text +=
        fmt::format("  from {} candidates at {} mounting points\n", table.columns(), table.mounting_points());
  for (const ScenarioMargin& margin : scenario_margins(table, placement)) {
    const SignalTable::Scenario& scenario = table.scenarios[margin.scenario];
    text += scenario.labels == 0
                ? fmt::format("  {}: no labels\n", scenario.name)
                : fmt::format("  {}: {} label{}, the weakest ({}) gets {:.4g} of its requirement\n",
                              scenario.name, scenario.labels, scenario.labels == 1 ? "" : "s",
                              table.labels[margin.label].id, margin.smallest_margin);
  }
  if (!table.apart.empty())
    text += fmt::format("  {} pairs of candidates are kept apart\n", table.apart.size());
  if (placement.question.objective != Objective::count ||
      placement.question.combination == Combination::weighted)
    text += fmt::format("  objective {:.9g}, lower bound {:.9g}, gap {:.2f} %\n", placement.objective_value,
                        placement.lower_bound, 100 * placement.gap());
  text += fmt::format("  bound: {}{}\n", behind_bound(placement.bound_proof),
                      placement.ties_settled ? "; of equal placements this has the widest margin" : "");
  text +=
      fmt::format("  solver {}, {:.2f} s{}\n", placement.solver, placement.seconds,
                  placement.status == Status::stopped
                      ? fmt::format("; stopped early: incumbent {:.6g}, bound {:.6g}, gap {:.1f} %",
                                    placement.objective_value, placement.lower_bound, 100 * placement.gap())
                      : "");
  return text;
}

std::string describe(const Reach& reach, const SignalTable& table) {
  const auto share = [&](std::size_t labels) {
    return table.rows() == 0 ? 100.0 : 100 * static_cast<double>(labels) / static_cast<double>(table.rows());
  };
  std::string text = fmt::format(
      "{} reach{} {} of {} labels, {:.1f} % ({}{}); ",
      reach.selected.size() == 1 ? "1 transceiver" : fmt::format("{} transceivers", reach.selected.size()),
      reach.selected.size() == 1 ? "es" : "", reach.reached, table.rows(), share(reach.reached),
      reach.question.model == CommunicationModel::cooperative ? "cooperative" : "non-cooperative",
      reach.question.redundant ? ", whichever unit fails" : "");
  text += reach.upper_bound <= reach.reached
              ? fmt::format("no {} reach more, proven.\n", reach.at_most)
              : fmt::format("no {} reach more than {}, {:.1f} %, proven.\n", reach.at_most, reach.upper_bound,
                            share(reach.upper_bound));
  std::vector<std::string_view> ids;
  for (const std::uint32_t j : reach.selected) ids.push_back(table.transceivers[j].id);
  text += fmt::format("  chosen: {}\n", fmt::join(ids, ", "));
  return text + fmt::format("  solver {}, {:.2f} s\n", reach.solver, reach.seconds);
}

std::string describe(const std::vector<CurvePoint>& curve, const SignalTable& table) {
  if (curve.empty() || table.rows() == 0) return {};
  std::string text = "  units   labels reached: at least   at most\n";
  const auto share = [&](std::size_t labels) {
    return 100 * static_cast<double>(labels) / static_cast<double>(table.rows());
  };
  for (const CurvePoint& point : curve)
    text += fmt::format("  {:5}                  {:7.1f} % {:7.1f} %\n", point.units, share(point.at_least),
                        share(point.at_most));
  return text;
}

int exit_code(Status status) {
  switch (status) {
    case Status::optimal:
    case Status::feasible:
      return done;
    case Status::infeasible:
      return answer_is_no;
    case Status::stopped:
      return stopped_early;
  }
  return internal_error;
}

}  // namespace shelfbeam::app
