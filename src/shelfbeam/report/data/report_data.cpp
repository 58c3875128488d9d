#include "shelfbeam/report/data/report_data.hpp"

#include <algorithm>

#include "shelfbeam/math/places.hpp"

namespace shelfbeam {

namespace {

SignalUnit unit_of(const SignalMatrix& matrix) {
  std::vector<double> requirements;
  for (const LabelRow& label : matrix.labels) requirements.push_back(label.requirement);
  return signal_unit(quantile(requirements, 0.5));
}

}  // namespace

ReportData::ReportData(const ReportInput& report_input)
    : input(report_input),
      outcome(outcome_of(input.matrix, input.plan.placement, input.plan.certificate)),
      sampling(sampling_summary(input.matrix)),
      uncertain(uncertain_labels(input.matrix, outcome)),
      mounting_points(places_of(positions_of(input.matrix.transceivers)).count),
      unit(unit_of(input.matrix)) {
  std::vector<double> heights;
  for (const LabelRow& label : input.matrix.labels) heights.push_back(label.position.z);
  levels = shelf_levels(heights);
}

std::size_t ReportData::unit_number(std::uint32_t column) const {
  const auto& selected = input.plan.placement.selected;
  return static_cast<std::size_t>(std::find(selected.begin(), selected.end(), column) - selected.begin()) + 1;
}

}  // namespace shelfbeam
