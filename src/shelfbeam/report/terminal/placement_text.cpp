#include "shelfbeam/report/terminal/placement_text.hpp"

#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/answer/weak_spots.hpp"
#include "shelfbeam/report/messages/availability.hpp"
#include "shelfbeam/report/messages/partial.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/messages/reasons.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string outcome(const Placement& placement) {
  std::string text = fmt::format("  {}", to_text(placement.status));
  if (placement.has_selection())
    text += fmt::format(": value {:.9g}, lower bound {:.9g}, gap {:.1f} %", placement.objective_value,
                        placement.lower_bound, 100 * placement.gap());
  return text +
         fmt::format("; {:.2f} s, solver {}\n", placement.seconds, solver_text(english(), placement.solver));
}

std::string infeasible(const Placement& placement, const SignalTable& table) {
  const bool has_options = !table.mounts.empty();
  const std::string no_selection = no_selection_reaches(english(), table.rows()) +
                                   (placement.problem.redundant ? " if any one unit fails" : "");
  if (placement.unreachable.empty())
    return fmt::format("{}: each {} (proven by {}).\n", no_selection,
                       not_all_together(english(), conflict_reason(english(), placement, has_options)),
                       solver_text(english(), placement.solver));
  std::string text =
      fmt::format("{}: {}.\n", no_selection, terminal_out_of_reach(english(), placement, has_options));
  const std::size_t shown = std::min<std::size_t>(10, placement.unreachable.size());
  for (std::size_t u = 0; u < shown; ++u) {
    const Unreachable& one = placement.unreachable[u];
    text += fmt::format("  {}: maximum signal {:.4g}, requirement {:.4g}", table.labels[one.label].id,
                        one.max_signal, one.requirement);
    if (one.max_signal == 0)
      text +=
          fmt::format(" ({})", no_signal_reason(english(), placement.problem, !table.row(one.label).empty()));
    text += '\n';
  }
  if (shown < placement.unreachable.size())
    text += fmt::format("  and {} more\n", placement.unreachable.size() - shown);
  return text;
}

std::string nothing_found(const Placement& placement) {
  const std::string needed = units_needed(english(), proven_count(placement));
  const std::string_view who = method_without_result(english(), placement);
  return who.empty() ? fmt::format("No placement was found in time; {}.\n", needed)
                     : fmt::format("{} found no placement; {}. A MIP solver may find one.\n", who, needed);
}

/// The number of labels that are lost if a unit fails, for each unit.
std::string single_unit_labels(const Placement& placement, const SignalTable& table) {
  std::vector<std::string> counts;
  std::size_t all = 0;
  for (const Critical& one : critical_units(table, placement.problem, placement.selected)) {
    counts.push_back(fmt::format("{} {}", table.transceivers[one.unit].id, one.labels.size()));
    all += one.labels.size();
  }
  return all == 0 ? "  no label depends on a single unit\n"
                  : fmt::format("  labels lost if one unit fails: {}\n", fmt::join(counts, ", "));
}

std::string solved(const Placement& placement, const SignalTable& table) {
  std::string text = fmt::format("{} {} ({}); {}.\n", units_reach(english(), placement.count()),
                                 all_labels(english(), table.rows()), model_of(placement.problem),
                                 terminal_bound(english(), placement));
  text += chosen(placement.selected, table);
  if (const std::string price = price_sentence(english(), placement); !price.empty())
    text += fmt::format("  {}\n", price);
  const bool has_choice =
      resolved({.combination = Combination::automatic}, table).combination == Combination::spend;
  if (has_choice && placement.problem.combination == Combination::lexicographic)
    text += "  prices differ but are not considered in this order of objectives\n";
  if (!table.mounts.empty())
    text += fmt::format("  from {} at {}\n", counted(table.columns(), "candidate"),
                        counted(table.mounting_points(), "mounting point"));
  for (const ScenarioMargin& margin : scenario_margins(table, placement)) {
    const SignalTable::Scenario& scenario = table.scenarios[margin.scenario];
    text += scenario.labels == 0
                ? fmt::format("  {}: no labels\n", scenario.name)
                : fmt::format(
                      "  {}: {}; the label with the minimum margin ({}) receives {:.4g} times its "
                      "requirement\n",
                      scenario.name, counted(scenario.labels, "label"), table.labels[margin.label].id,
                      margin.smallest_margin);
  }
  return text + single_unit_labels(placement, table);
}

std::string partial(const Placement& placement, const SignalTable& table) {
  std::string text;
  if (placement.has_selection()) {
    text = fmt::format("{} {} ({}).\n{}", units_reach(english(), placement.count()),
                       labels_reached(english(), placement.partial->reached, table.rows()),
                       model_of(placement.problem), chosen(placement.selected, table));
    if (const std::string price = price_sentence(english(), placement); !price.empty())
      text += fmt::format("  {}\n", price);
  } else if (placement.status != Status::infeasible) {
    text = nothing_found(placement);
  }
  text +=
      fmt::format("{}{}\n", text.empty() ? "" : "  ", partial_sentence(english(), placement, table.rows()));
  if (placement.partial->goal == ReachGoal::given) return text;
  return text + fmt::format("  {}; {:.2f} s, solver {}\n  bound: {}\n", to_text(placement.status),
                            placement.seconds, solver_text(english(), placement.solver),
                            bound_proof_text(english(), placement.bound_proof));
}

std::vector<std::string> added_to(const Selection& before, const Selection& after, const SignalTable& table) {
  std::vector<std::string> ids;
  for (const std::uint32_t j : after)
    if (!std::binary_search(before.begin(), before.end(), j)) ids.push_back(table.transceivers[j].id);
  return ids;
}

}  // namespace

std::string model_of(const PlacementProblem& problem) {
  return fmt::format("{}{}", to_text(problem.model), failure_clause(english(), problem));
}

std::string chosen(const Selection& selected, const SignalTable& table) {
  std::vector<std::string_view> ids;
  ids.reserve(selected.size());
  for (const std::uint32_t j : selected) ids.push_back(table.transceivers[j].id);
  return ids.empty() ? "" : fmt::format("  chosen: {}\n", fmt::join(ids, ", "));
}

std::string availability_answer(const Availability& availability, const Placement& placement,
                                const SignalTable& table) {
  return availability_sentence(english(), availability, placement,
                               [&](LabelId label) { return table.labels[label].id; });
}

std::string availability_details(const Availability& availability, const Placement& placement,
                                 const SignalTable& table) {
  std::string text;
  if (const std::string bound = availability_bound(english(), availability, placement); !bound.empty())
    text += fmt::format("  {}\n", bound);
  if (const std::string advice = states_recommendation(english(), availability, placement); !advice.empty())
    text += fmt::format("  {}\n", advice);
  for (const std::string& remark : availability_remarks(english(), availability, placement))
    text += fmt::format("  {}\n", remark);
  if (const std::string lost =
          lost_sentence(english(), availability, [&](LabelId label) { return table.labels[label].id; });
      !lost.empty())
    text += fmt::format("  {}\n", lost);
  const std::vector<ReasonRow> rows = reason_rows(english(), availability, placement);
  if (!rows.empty()) text += fmt::format("  {}:\n", english()("reasons.title"));
  const bool is_plan = availability.nominal.states > 0;
  for (const ReasonRow& row : rows)
    text += fmt::format("    {}\n", english().say(is_plan ? "reasons.line" : "reasons.line_mounted",
                                                  row.change, row.taken, row.units));
  return text;
}

std::string describe(const Placement& placement, const SignalTable& table) {
  if (placement.partial) return partial(placement, table);
  const bool is_infeasible = placement.status == Status::infeasible;
  std::string text = is_infeasible               ? infeasible(placement, table)
                     : placement.has_selection() ? solved(placement, table)
                                                 : nothing_found(placement);
  if (const std::string conflicts = conflict_sentence(english(), placement); !conflicts.empty())
    text += fmt::format("  {}\n", conflicts);
  text += outcome(placement);
  if (is_infeasible) return text;
  return text + fmt::format("  bound: {}{}\n", bound_proof_text(english(), placement.bound_proof),
                            placement.ties_settled
                                ? "; among equally good placements, this one has the largest minimum margin"
                                : "");
}

std::string describe(const Alternatives& alternatives, const Placement& placement, const SignalTable& table,
                     bool has_reserve) {
  if (alternatives.empty()) return {};
  std::string text = "  alternatives on the simulated signals:\n";
  const auto add = [&](const std::string& choice, const Alternative& one, const std::string& effect) {
    text += fmt::format("    {}: {}{}; {}\n", choice, counted(one.selected.size(), "transceiver"),
                        one.price ? ", new spend " + money(english(), one.price->to_spend, one.price) : "",
                        effect);
  };
  if (const auto& one = alternatives.one_fewer)
    add(one->selected.size() + 1 < placement.count() ? "fewer" : "one fewer", *one,
        fmt::format("{} lost{}", counted(table.rows() - one->reached, "label"),
                    one->is_proven ? "" : fmt::format(" (at least {})", table.rows() - one->max_reached)));
  if (const auto& one = alternatives.one_more)
    add(fmt::format("one more ({})", fmt::join(added_to(placement.selected, one->selected, table), ", ")),
        *one,
        fmt::format("{}{} of {} labels survive any failure",
                    has_reserve ? fmt::format("the weakest label receives {:.3g} times its requirement, ",
                                              one->smallest_margin)
                                : std::string(),
                    english().grouped(one->secure), english().grouped(table.rows())));
  if (const auto& one = alternatives.survives_failure)
    add("every failure survived", *one, one->is_proven ? "proven minimum" : "not proven to be the minimum");
  if (alternatives.cannot_survive) text += "    every failure survived: not possible with these candidates\n";
  return text;
}

}  // namespace shelfbeam
