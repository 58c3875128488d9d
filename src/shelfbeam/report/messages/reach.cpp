#include "shelfbeam/report/messages/reach.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

std::string conflicts_clause(const Placement& placement) {
  if (placement.min_spacing > 0)
    return fmt::format("units must be at least {:.6g} m apart", placement.min_spacing);
  return placement.forbidden_pairs > 0 ? "some candidates must not be chosen together" : "";
}

}  // namespace

std::string units_reach(std::size_t units) {
  return counted(units, "transceiver") + (units == 1 ? " reaches" : " reach");
}

std::string all_labels(std::size_t labels) {
  return labels == 1 ? "the only label" : "all " + counted(labels, "label");
}

std::string labels_reached(std::size_t reached, std::size_t labels) {
  if (reached == labels) return all_labels(labels);
  return fmt::format("{} of {}", grouped(reached), counted(labels, "label"));
}

std::string no_selection_reaches(std::size_t labels) {
  return "No selection reaches " + all_labels(labels);
}

std::string_view failure_clause(const PlacementProblem& problem) {
  return problem.redundant ? ", even if any one unit fails" : "";
}

std::string_view method_without_result(const Placement& placement) {
  if (placement.solver == "greedy") return "The greedy method";
  return placement.solver == "search" ? "The search" : "";
}

std::string conflict_sentence(const Placement& placement) {
  const std::string forbidden = conflicts_clause(placement);
  if (forbidden.empty()) return {};
  const std::size_t pairs = placement.forbidden_pairs;
  return fmt::format("{} {} excluded{}", counted(pairs, "pair of candidates", "pairs of candidates"),
                     pairs == 1 ? "is" : "are", placement.min_spacing > 0 ? ": " + forbidden : "");
}

std::string conflict_reason(const Placement& placement, bool has_options) {
  const std::string options = has_options ? "each mounting point takes only one unit" : "";
  const std::string forbidden = conflicts_clause(placement);
  return options + (options.empty() || forbidden.empty() ? "" : " and ") + forbidden;
}

std::string not_all_together(std::string_view conflict_reason) {
  return fmt::format("can be reached, but not all of them together, because {}", conflict_reason);
}

std::string_view no_signal_reason(const PlacementProblem& problem, bool is_heard) {
  if (!is_heard) return "no light arrives; check whether the label lies inside an object or faces into one";
  if (problem.redundant) return "light arrives from only one mounting point, and the unit there may fail";
  return "light arrives only from candidates that an installed unit excludes";
}

std::string dark_labels(std::size_t labels) {
  if (labels == 1)
    return "No light reaches one of these labels: check whether it lies inside an object or faces into one.";
  return fmt::format(
      "No light reaches {} of these labels: check whether they lie inside an object or face into one.",
      grouped(labels));
}

std::string terminal_out_of_reach(const Placement& placement, bool has_options) {
  const PlacementProblem& problem = placement.problem;
  const std::string lost = grouped(placement.unreachable.size()) + " cannot be reached";
  if (problem.model == CommunicationModel::non_cooperative)
    return lost + (problem.redundant ? " by two units" : " even by the best candidate");
  return fmt::format(
      "{} even by {}{}", lost,
      has_options ? "the best options of all mounting points together" : "all candidates together",
      problem.redundant ? " if the strongest unit fails" : "");
}

std::string page_out_of_reach(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const PlacementProblem& problem = placement.problem;
  const std::size_t candidates = data.input.matrix.columns();
  std::string even;
  if (problem.model == CommunicationModel::non_cooperative)
    even = problem.redundant ? " by two units, of which one may fail"
                             : fmt::format(", even by the best of {}", counted(candidates, "candidate"));
  else if (data.has_options())
    even = fmt::format(", even with the best option of {} switched on",
                       data.mounting_points == 1
                           ? "the only mounting point"
                           : fmt::format("each of the {} mounting points", grouped(data.mounting_points)));
  else
    even = candidates == 1 ? ", even with the only candidate switched on"
                           : fmt::format(", even with all {} candidates switched on", grouped(candidates));
  return fmt::format("{} of {} cannot be reached{}", grouped(placement.unreachable.size()),
                     counted(data.outcome.labels.size(), "label"), even);
}

std::string_view maximum_signal_condition(const ReportData& data) {
  if (data.input.plan.placement.problem.redundant)
    return data.has_options()
               ? "if the best option of every mounting point were switched on and the strongest unit failed"
               : "if every candidate were switched on and the strongest failed";
  return data.has_options() ? "if the best option of every mounting point were switched on"
                            : "if every candidate were switched on";
}

}  // namespace shelfbeam
