#include "shelfbeam/plan/states/causes_alone.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/base/deadline.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/placement/problem/progress_alone.hpp"
#include "shelfbeam/plan/states/deciding_labels.hpp"
#include "shelfbeam/plan/states/goal_rules.hpp"
#include "shelfbeam/plan/states/reflectance_ends.hpp"
#include "shelfbeam/plan/states/sample_placement.hpp"

namespace shelfbeam {

namespace {

constexpr std::uint32_t batches_of_one_state = 64;  ///< the only state of a sample has no others beside it
constexpr std::string_view no_cause = "none";       ///< the shop as the file gives it misses the label, too

}  // namespace

const CausesAlone::Part CausesAlone::as_given{{}, "as given"};

CausesAlone::CausesAlone(const Store& store, const Scene& scene, const SignalTable& table,
                         const PlacementProblem& problem, const Availability& found,
                         const SimulationOptions& options, std::uint32_t states, ResultLog& log,
                         const RunControl& control)
    : scene_(scene),
      low_scene_(with_reflectances_at(RangeEnd::low, scene)),
      low_store_(with_reflectances_at(RangeEnd::low, store)),
      states_(store, scene_, options.seed),
      low_states_(low_store_, low_scene_, options.seed),
      table_(table),
      problem_(problem),
      found_(found),
      options_(options),
      count_(std::min(states, max_states)),
      log_(log),
      control_(control) {}

std::vector<CausesAlone::Part> CausesAlone::causes() const {
  std::vector<Part> parts;
  if (states_.varies(Cause::reflectance) && has_reflectance_range(scene_))
    parts.push_back({Cause::reflectance, "low reflectances"});
  for (const Cause cause : states_.causes())
    parts.push_back({cause, fmt::format("{} alone", to_text(cause))});
  return parts;
}

StateSample CausesAlone::sample(const Part& part) const {
  const Cause cause = part.cause.value_or(Cause::reflectance);
  const bool is_low = part.cause == Cause::reflectance, is_fixed = cause == Cause::reflectance;
  SampleStates which{.only = cause, .purpose = part.purpose};
  which.count = is_fixed ? 1 : count_;
  if (is_fixed) which.batches = batches_of_one_state;
  return {is_low ? low_states_ : states_, is_low ? low_scene_ : scene_, options_, which, log_, control_};
}

MissAllowance CausesAlone::allowance(std::span<const LabelId> labels, std::uint32_t states) const {
  return allowance_of(found_.goal, found_.required, labels, states);
}

void CausesAlone::examine(std::span<const ColumnId> selected, const std::optional<PlaceOptions>& place,
                          Availability& found) const {
  const StateSample fixed = sample(as_given);
  const ScenarioMisses given = DecidingLabels(fixed, table_, problem_).misses(selected);
  std::vector<CauseAlone> rows;
  const std::vector<Part> parts = causes();
  Deadline deadline(place ? place->time_limit_s : 0);
  ProgressAlone progress(control_.progress);
  const RunControl control{control_.threads, control_.cancel, &progress};
  for (const Part& part : parts) {
    const StateSample states = sample(part);
    DecidingLabels deciding(states, table_, problem_);
    const StateOutcome outcome = outcome_of(deciding.misses(selected), selected.size(), states.count());
    CauseAlone row;
    row.cause = to_text(*part.cause);
    row.states = states.count();
    for (std::uint32_t i = 0; i < table_.rows(); ++i)
      if (given.of_label[i] == 0 && outcome.is_below(i, found_.required[i])) row.taken.push_back(i);
    if (place && outcome.keeps_to(found_.goal, found_.required)) {
      row.units = selected.size();
    } else if (place) {
      deciding.add_if([&](LabelId i) { return outcome.missed[i] > 0; });
      SamplePlacement placed = place_on_sample(
          deciding, problem_, [&](auto labels) { return allowance(labels, states.count()); }, *place,
          deadline, control);
      row.units = placed.selected.size();
      row.lower_bound = placed.lower_bound;
      row.unreachable = std::move(placed.unreachable);
    }
    rows.push_back(std::move(row));
  }
  found.missed_as_given = static_cast<std::size_t>(std::count_if(
      given.of_label.begin(), given.of_label.end(), [](std::uint32_t misses) { return misses > 0; }));
  found.alone = std::move(rows);
}

std::vector<LostLabel> CausesAlone::lost(std::span<const LabelId> labels,
                                         std::span<const ColumnId> selected) const {
  std::vector<LostLabel> lost;
  for (const LabelId i : labels) lost.push_back({i, {}});
  if (labels.empty()) return lost;
  const auto add = [&](const Part& part, std::string_view name) {
    const StateSample states = sample(part);
    const std::vector<double> received = states.received(labels, selected, problem_);
    for (std::size_t k = 0; k < labels.size(); ++k) {
      const auto begin = received.begin() + static_cast<std::ptrdiff_t>(k * states.count());
      const bool is_known = !lost[k].causes.empty() && lost[k].causes.front() == no_cause;
      if (!is_known && !is_met(*std::max_element(begin, begin + states.count()),
                               requirement_of(table_.labels[labels[k]], problem_.model)))
        lost[k].causes.emplace_back(name);
    }
  };
  add(as_given, no_cause);
  for (const Part& part : causes()) add(part, to_text(*part.cause));
  return lost;
}

}  // namespace shelfbeam
