#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/report/data/distributions.hpp"
#include "shelfbeam/report/data/label_names.hpp"
#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// Labels of about the same height, drawn on one plan.
struct ShelfLevel {
  double low = 0, high = 0;     ///< m, heights of its lowest and highest label
  std::vector<LabelId> labels;  ///< ascending

  /// "labels at 0.85 to 1.00 m"
  std::string heights(const Words& words) const;
};

/// The largest difference in height within a level, m.
inline constexpr double level_band = 0.25;

/// Levels from the lowest label up. A label belongs to a level if it is at most level_band above its lowest.
std::vector<ShelfLevel> shelf_levels(std::span<const double> heights);

/// The chosen units in walking order, as indices into Placement::selected.
std::vector<std::size_t> walking_order_of(const ReportInput& input);

/// The type of transceiver with this name; null if the scene has none.
const TransceiverType* unit_type(const Scene& scene, std::string_view name);

/// The data that several sections of a report share.
struct ReportData {
  explicit ReportData(const ReportInput& report_input);

  const ReportInput& input;
  Words words;  ///< in the language of the store
  LabelNames names;
  Outcome outcome;  ///< units in walking order
  SamplingSummary sampling;
  std::size_t uncertain;  ///< labels whose verdict sampling error could change
  std::size_t mounting_points;
  std::vector<ShelfLevel> levels;
  SignalUnit unit;

  /// Without a selection, the report shows the maximum signal of each label.
  bool has_selection() const {
    return !input.plan.placement.selected.empty() && input.plan.placement.status != Status::infeasible;
  }
  /// Some mounting points have several candidates, of which at most one can be chosen.
  bool has_options() const { return mounting_points < input.matrix.columns(); }
  /// The label has an entry above 0.
  bool is_heard(LabelId row) const {
    const auto signals = input.matrix.mean_row(row);
    return std::any_of(signals.begin(), signals.end(), [](float signal) { return signal > 0; });
  }
  /// The signal that the floor plans show: received, or without a selection the maximum.
  double shown_signal(LabelId row) const {
    return has_selection() ? outcome.labels[row].signal : outcome.labels[row].best;
  }
  bool has_direct() const { return input.matrix.direct.size() == input.matrix.mean.size(); }
  const LabelRow& label(LabelId row) const { return input.matrix.labels[row]; }
  const TransceiverColumn& transceiver(std::uint32_t column) const {
    return input.matrix.transceivers[column];
  }
  /// Verified as reached, or without verdicts met.
  bool is_reached(LabelId row) const {
    return input.plan.has_verdicts() ? input.plan.certificate->labels[row].verdict == Verdict::reached
                                     : outcome.labels[row].met;
  }
  /// The number of a chosen unit in tables and on drawings: its place in walking order, from 1.
  std::size_t unit_number(std::uint32_t column) const;
};

}  // namespace shelfbeam
