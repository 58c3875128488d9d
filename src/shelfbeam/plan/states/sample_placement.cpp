#include "shelfbeam/plan/states/sample_placement.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/math/order.hpp"

namespace shelfbeam {

namespace {

// Share of the time left that each placement over a growing table may use, and its minimum in s.
constexpr double share_of_pass = 0.6, min_part_s = 1;

}  // namespace

SamplePlacement place_on_sample(DecidingLabels& deciding, const PlacementProblem& problem,
                                const AllowanceOf& allowance, const PlaceOptions& options,
                                const Deadline& deadline, const RunControl& control) {
  SamplePlacement result;
  const MissAllowance of_all = allowance(all_numbers<LabelId>(deciding.of_shop()));
  PlaceOptions part = options;
  for (;;) {
    const double share = deciding.labels().size() < deciding.of_shop() ? share_of_pass : 1;
    part.time_limit_s = std::max(min_part_s, share * deadline.seconds_left());
    const ScenarioPlacement found =
        place_over_scenarios(deciding.table(), problem, allowance(deciding.labels()), part, control);
    result.lower_bound = std::max(result.lower_bound, found.lower_bound);
    for (const LabelId row : found.unreachable) result.unreachable.push_back(deciding.labels()[row]);
    if (control.cancelled()) throw Interrupted("the plan was stopped");
    if (!found.has_selection()) return result;
    ScenarioMisses misses = deciding.misses(found.selected);
    if (of_all.excess(misses) == 0 ||
        deciding.add_if([&](LabelId i) { return misses.of_label[i] > 0; }) == 0) {
      result.selected = found.selected;
      result.misses = std::move(misses);
      result.value = found.value;
      return result;
    }
    part.start = found.selected;
  }
}

}  // namespace shelfbeam
