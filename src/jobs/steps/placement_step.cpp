#include "jobs/steps/placement_step.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/coverage/coverage_curve.hpp"
#include "shelfbeam/placement/coverage/fewest_units.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/report/terminal/coverage_text.hpp"
#include "shelfbeam/report/terminal/placement_text.hpp"

namespace shelfbeam::jobs {

namespace {

template <class Result>
PlacementAnswer common(Result& result) {
  PlacementAnswer answer;
  answer.status = result.status;
  answer.selected = std::move(result.selected);
  answer.code = exit_code_of(result.status);
  answer.steps = std::move(result.steps);
  answer.seconds = result.seconds;
  return answer;
}

PlacementAnswer fewest(const SignalTable& table, const PlacementQuestion& question,
                       const PlaceOptions& options, const RunControl& control) {
  FewestUnits found = fewest_units(table, question.problem, *question.partial.share, options, control);
  std::string json = fewest_units_json(found, table), text = describe(found, table);
  PlacementAnswer answer = common(found);
  answer.has_selection = found.has_selection;
  answer.reached = found.reached;
  answer.value = static_cast<double>(answer.selected.size());
  answer.bound = static_cast<double>(found.count_lower_bound);
  answer.json = std::move(json);
  answer.text = std::move(text);
  return answer;
}

PlacementAnswer most(const SignalTable& table, const PlacementQuestion& question, const PlaceOptions& options,
                     const RunControl& control) {
  MaxCoverage found = maximise_coverage(table, question.problem, *question.partial.at_most, options, control);
  std::string json = coverage_json(found, table), text = describe(found, table);
  PlacementAnswer answer = common(found);
  answer.has_selection = true;
  answer.reached = found.reached;
  answer.value = found.weight ? found.weight->reached : static_cast<double>(found.reached);
  answer.bound = found.weight ? found.weight->upper_bound : static_cast<double>(found.upper_bound);
  answer.json = std::move(json);
  answer.text = std::move(text);
  return answer;
}

PlacementAnswer cover(const SignalTable& table, const PlacementQuestion& question,
                      const PlaceOptions& options, const RunControl& control) {
  Placement placement = place(table, question.problem, options, control);
  CoverageCurve curve;
  if (question.curve && placement.has_selection())
    curve = add_curve(placement, table, options.time_limit_s, control);
  std::string json = placement_json(placement, table, curve);
  std::string text = describe(placement, table) + describe(curve, table);
  const double value = placement.objective_value, bound = placement.lower_bound;
  PlacementAnswer answer = common(placement);
  answer.has_selection = placement.has_selection();
  answer.reached = answer.has_selection ? table.rows() : 0;
  answer.value = value;
  answer.bound = bound;
  answer.json = std::move(json);
  answer.text = std::move(text);
  if (!curve.is_complete) answer.code = stopped_early;
  return answer;
}

}  // namespace

PlacementAnswer answer(const SignalTable& table, const PlacementQuestion& question,
                       const PlaceOptions& options, const RunControl& control) {
  check_question(question.partial, question.problem);
  if (question.partial.share) return fewest(table, question, options, control);
  return question.partial.at_most ? most(table, question, options, control)
                                  : cover(table, question, options, control);
}

Selection start_of(Selection selected, const SignalTable& table, const PlacementQuestion& question,
                   const std::string& name) {
  for (std::uint32_t j = 0; j < table.columns(); ++j)
    if (table.transceivers[j].installed && !std::binary_search(selected.begin(), selected.end(), j))
      selected.insert(std::lower_bound(selected.begin(), selected.end(), j), j);
  const Check check = check_selection(table, resolved(question.problem, table), selected);
  const auto fail = [&](const std::string& problem) {
    throw InputError(name, problem, "begin with a selection that answers this question, or with none");
  };
  if (!check.allowed()) fail("selects units that exclude one another");
  if (!question.partial.is_asked() && !check.met())
    fail(fmt::format("does not reach {} of {} labels", check.unmet.size(), table.rows()));
  if (question.partial.at_most && selected.size() > *question.partial.at_most)
    fail(fmt::format("selects {} units, more than {}", selected.size(), *question.partial.at_most));
  return selected;
}

}  // namespace shelfbeam::jobs
