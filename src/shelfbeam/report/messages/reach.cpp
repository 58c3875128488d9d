#include "shelfbeam/report/messages/reach.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"

namespace shelfbeam {

namespace {

std::string what_is_forbidden(const Placement& placement) {
  if (placement.min_spacing > 0) return fmt::format("units must be {:.6g} m apart", placement.min_spacing);
  return placement.forbidden_pairs > 0 ? "some pairs must not be chosen together" : "";
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

std::string_view whichever_fails(const Question& question) {
  return question.redundant ? ", whichever unit fails" : "";
}

std::string_view who_gave_up(const Placement& placement) {
  if (placement.solver == "greedy") return "The greedy method";
  return placement.solver == "search" ? "The search" : "";
}

std::string kept_apart(const Placement& placement) {
  const std::string forbidden = what_is_forbidden(placement);
  if (forbidden.empty()) return {};
  const std::size_t pairs = placement.forbidden_pairs;
  return fmt::format("{} {} kept apart: {}", counted(pairs, "pair of candidates", "pairs of candidates"),
                     pairs == 1 ? "is" : "are", forbidden);
}

std::string why_exclusive(const Placement& placement, bool has_options) {
  const std::string options = has_options ? "a mounting point holds one unit" : "";
  const std::string forbidden = what_is_forbidden(placement);
  return options + (options.empty() || forbidden.empty() ? "" : " and ") + forbidden;
}

std::string not_all_at_once(std::string_view why_exclusive) {
  return fmt::format("could be reached, but not all of them at once, because {}", why_exclusive);
}

std::string_view why_nothing(const Question& question, bool is_heard) {
  if (!is_heard) return "no light arrives at all: is it inside something, or facing into it?";
  if (question.redundant) return "light arrives from one place only, and the unit there may fail";
  return "light arrives only from candidates that an installed unit rules out";
}

std::string dark_labels(std::size_t labels) {
  if (labels == 1) return fmt::format("At one of them {}", why_nothing({}, false));
  return fmt::format("At {} of them no light arrives at all: are they inside something, or facing into it?",
                     grouped(labels));
}

std::string terminal_out_of_reach(const Placement& placement, bool has_options) {
  const Question& question = placement.question;
  const std::string lost = grouped(placement.unreachable.size()) + " cannot be reached";
  if (question.model == CommunicationModel::non_cooperative)
    return lost + (question.redundant ? " by two units at once" : " even by the best candidate");
  return fmt::format(
      "{} even by {}{}", lost,
      has_options ? "the best options of all mounting points together" : "all candidates together",
      question.redundant ? " when the strongest fails" : "");
}

std::string page_out_of_reach(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const Question& question = placement.question;
  const std::size_t candidates = data.input.matrix.columns();
  std::string even;
  if (question.model == CommunicationModel::non_cooperative)
    even = question.redundant ? "each by two units at once, of which one may fail"
                              : fmt::format("even by the best of {}", counted(candidates, "candidate"));
  else if (data.has_options())
    even = fmt::format("even with the best option of {} on",
                       data.mounting_points == 1
                           ? "the only mounting point"
                           : fmt::format("all {} mounting points", grouped(data.mounting_points)));
  else
    even = candidates == 1 ? "even with the only candidate on"
                           : fmt::format("even with all {} candidates on", grouped(candidates));
  return fmt::format("{} of {} cannot be reached, {}", grouped(placement.unreachable.size()),
                     counted(data.outcome.labels.size(), "label"), even);
}

std::string_view everything_on(const ReportData& data) {
  if (data.input.plan.placement.question.redundant)
    return data.has_options()
               ? "if the best option of every mounting point were on and the strongest unit failed"
               : "if every candidate were on and the strongest failed";
  return data.has_options() ? "if the best option of every mounting point were on"
                            : "if every candidate were on";
}

}  // namespace shelfbeam
