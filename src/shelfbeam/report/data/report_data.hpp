#pragma once

#include <algorithm>
#include <vector>

#include "shelfbeam/report/data/levels.hpp"
#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/sampling.hpp"
#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

/// Everything that the sections of a report draw on, computed once.
struct ReportData {
  explicit ReportData(const ReportInput& report_input);

  const ReportInput& input;
  Outcome outcome;
  SamplingSummary sampling;
  std::size_t uncertain;  ///< labels that sampling error could turn
  std::size_t mounting_points;
  std::vector<ShelfLevel> levels;
  SignalUnit unit;

  /// Otherwise the report shows the most that each label could get.
  bool has_selection() const {
    return !input.plan.placement.selected.empty() && input.plan.placement.status != Status::infeasible;
  }
  /// Some mounting points have several candidates, of which one at most can be chosen.
  bool has_options() const { return mounting_points < input.matrix.columns(); }
  /// The label has some entry above 0.
  bool is_heard(std::uint32_t row) const {
    const auto signals = input.matrix.mean_row(row);
    return std::any_of(signals.begin(), signals.end(), [](float signal) { return signal > 0; });
  }
  bool has_direct() const { return input.matrix.direct.size() == input.matrix.mean.size(); }
  const LabelRow& label(std::uint32_t row) const { return input.matrix.labels[row]; }
  const TransceiverColumn& transceiver(std::uint32_t column) const {
    return input.matrix.transceivers[column];
  }
  /// Position of a chosen unit in the table and on the plans, from 1.
  std::size_t unit_number(std::uint32_t column) const;
};

}  // namespace shelfbeam
