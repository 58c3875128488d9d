#include "shelfbeam/report/data/report_data.hpp"

#include <algorithm>
#include <utility>

#include "shelfbeam/math/distinct_positions.hpp"
#include "shelfbeam/math/order.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/data/walking_order.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

SignalUnit unit_of(const Words& words, const SignalMatrix& matrix) {
  std::vector<double> requirements;
  for (const LabelRow& label : matrix.labels) requirements.push_back(label.requirement);
  return signal_unit(words, quantile(requirements, 0.5));
}

}  // namespace

ReportData::ReportData(const ReportInput& report_input)
    : input(report_input),
      words(words_of(input.scene)),
      names(input.scene, input.matrix, words),
      outcome(outcome_of(input.matrix, input.plan.placement, input.plan.certificate)),
      sampling(sampling_summary(input.matrix)),
      uncertain(uncertain_labels(input.matrix, outcome)),
      mounting_points(distinct_positions(positions_of(input.matrix.transceivers)).count),
      unit(unit_of(words, input.matrix)) {
  std::vector<double> heights;
  for (const LabelRow& label : input.matrix.labels) heights.push_back(label.position.z);
  levels = shelf_levels(heights);
  std::vector<UnitOutcome> in_order;
  for (const std::size_t k : walking_order_of(input)) in_order.push_back(outcome.units[k]);
  outcome.units = std::move(in_order);
}

std::vector<std::size_t> walking_order_of(const ReportInput& input) {
  std::vector<Vec3> positions;
  for (const std::uint32_t column : input.plan.placement.selected)
    positions.push_back(input.matrix.transceivers[column].position);
  return walking_order(positions);
}

const TransceiverType* unit_type(const Scene& scene, std::string_view name) {
  const auto found = std::find_if(scene.transceiver_types.begin(), scene.transceiver_types.end(),
                                  [&](const TransceiverType& type) { return type.name == name; });
  return found == scene.transceiver_types.end() ? nullptr : &*found;
}

std::size_t ReportData::unit_number(std::uint32_t column) const {
  const auto is_it = [&](const UnitOutcome& one) { return one.column == column; };
  return static_cast<std::size_t>(std::find_if(outcome.units.begin(), outcome.units.end(), is_it) -
                                  outcome.units.begin()) +
         1;
}

std::string ShelfLevel::heights(const Words& words) const {
  const std::string from = words.fixed(low, 2), to = words.fixed(high, 2);
  return from == to ? words.say("coverage.one_height", from) : words.say("coverage.heights", from, to);
}

std::vector<ShelfLevel> shelf_levels(std::span<const double> heights) {
  // Heights with two decimals that differ by exactly the band belong to one level despite rounding.
  constexpr double slack = 1e-9;
  std::vector<ShelfLevel> levels;
  for (const LabelId label : ordered_by<LabelId>(heights.size(), [&](LabelId i) { return heights[i]; })) {
    const double z = heights[label];
    if (levels.empty() || z - levels.back().low > level_band + slack) levels.push_back({z, z, {}});
    levels.back().high = z;
    levels.back().labels.push_back(label);
  }
  for (ShelfLevel& level : levels) std::sort(level.labels.begin(), level.labels.end());
  return levels;
}

}  // namespace shelfbeam
