#include "shelfbeam/report/messages/reach.hpp"

#include <fmt/format.h>

#include "shelfbeam/base/text.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

std::string conflicts_clause(const Words& words, const Placement& placement) {
  if (placement.min_spacing > 0)
    return words.say("reach.conflict.spacing", words.plain(placement.min_spacing));
  return placement.forbidden_pairs > 0 ? words.say("reach.conflict.pairs") : std::string();
}

}  // namespace

std::string units_reach(const Words& words, std::size_t units) {
  return words.say_count("reach.units", units);
}

std::string all_labels(const Words& words, std::size_t labels) {
  return words.say_count("reach.all", labels);
}

std::string labels_reached(const Words& words, std::size_t reached, std::size_t labels) {
  if (reached == labels) return all_labels(words, labels);
  return words.say_count("reach.some", labels, words.grouped(reached));
}

std::string no_selection_reaches(const Words& words, std::size_t labels) {
  return words.say("reach.none", all_labels(words, labels));
}

std::string_view failure_clause(const Words& words, const PlacementProblem& problem) {
  return problem.redundant ? words("reach.failure") : "";
}

std::string_view method_without_result(const Words& words, const Placement& placement) {
  const auto& [method, backend] = placement.solver;
  if (method == Method::greedy) return words("reach.greedy");
  return method == Method::search && !backend ? words("reach.search") : "";
}

std::string conflict_sentence(const Words& words, const Placement& placement) {
  const std::string forbidden = conflicts_clause(words, placement);
  if (forbidden.empty()) return {};
  return words.say_count(placement.min_spacing > 0 ? "reach.excluded_because" : "reach.excluded",
                         placement.forbidden_pairs, forbidden);
}

std::string conflict_reason(const Words& words, const Placement& placement, bool has_options) {
  std::string forbidden = conflicts_clause(words, placement);
  if (!has_options) return forbidden;
  std::string options = words.say("reach.conflict.options");
  return forbidden.empty() ? options : words.say("reach.conflict.both", options, forbidden);
}

std::string not_all_together(const Words& words, std::string_view conflict_reason) {
  return words.say("reach.conflict.together", conflict_reason);
}

std::string_view no_signal_reason(const Words& words, const PlacementProblem& problem, bool is_heard) {
  if (!is_heard) return words("reach.no_signal.dark");
  return words(problem.redundant ? "reach.no_signal.single" : "reach.no_signal.excluded");
}

std::string dark_labels(const Words& words, std::size_t labels) {
  return words.say_count("reach.dark", labels);
}

std::string terminal_out_of_reach(const Words& words, const Placement& placement, bool has_options) {
  const PlacementProblem& problem = placement.problem;
  const std::string lost = words.grouped(placement.unreachable.size());
  if (problem.model == CommunicationModel::non_cooperative)
    return words.say(problem.redundant ? "reach.lost.two" : "reach.lost.best", lost);
  if (problem.redundant)
    return words.say(has_options ? "reach.lost.options_failure" : "reach.lost.candidates_failure", lost);
  return words.say(has_options ? "reach.lost.options" : "reach.lost.candidates", lost);
}

std::string page_out_of_reach(const ReportData& data) {
  const Placement& placement = data.input.plan.placement;
  const PlacementProblem& problem = placement.problem;
  const std::size_t candidates = data.input.matrix.columns();
  const std::string lost = data.words.grouped(placement.unreachable.size());
  const std::string labels = data.words.say_count("noun.label", data.outcome.labels.size());
  if (problem.model == CommunicationModel::non_cooperative)
    return problem.redundant ? data.words.say("reach.lost_of.two", lost, labels)
                             : data.words.say_count("reach.lost_of.best", candidates, lost, labels);
  if (data.has_options())
    return data.words.say_count("reach.lost_of.options", data.mounting_points, lost, labels);
  return data.words.say_count("reach.lost_of.candidates", candidates, lost, labels);
}

std::string_view maximum_signal_condition(const ReportData& data) {
  if (data.input.plan.placement.problem.redundant)
    return data.words(data.has_options() ? "reach.if.options_failure" : "reach.if.candidates_failure");
  return data.words(data.has_options() ? "reach.if.options" : "reach.if.candidates");
}

}  // namespace shelfbeam
