#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/chart/palette.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/mounting/mounting_sheet.hpp"

namespace shelfbeam {

/// The floor plans of a report. `definitions` contains the store, the candidates and the chosen units once;
/// plans reference them, so that a plan costs little more than its labels.
class Maps {
 public:
  explicit Maps(const ReportData& data);

  /// A hidden <svg> that must precede the plans.
  std::string definitions() const;
  /// The shop with its numbered units, or with the labels that no selection reaches, as a <figure>.
  std::string overview(const std::string& description) const;
  /// Labels of one level coloured by margin, as a <figure>; without a selection, by their maximum signal.
  std::string margin_map(std::size_t level) const;
  /// Direct and total signal of one level side by side in the same colour scale.
  std::string signal_maps(std::size_t level) const;
  /// CSS variables with the colours of the signal scale.
  std::string colours(bool dark) const { return signal_colours(scale_, dark); }
  /// The mounting sheet, which the page shows beside the plans.
  const std::vector<MountedUnit>& sheet() const { return sheet_; }
  /// The level with the most labels; the lowest of several.
  std::size_t fullest_level() const { return fullest_; }

 private:
  std::size_t class_of(LabelId label) const;
  std::vector<Point> positions(const std::vector<LabelId>& labels) const;
  void draw_names(SvgCanvas& canvas) const;
  std::string picture(const std::string& marks, const std::string& css_class,
                      const std::string& description) const;
  std::string margin_legend(const ShelfLevel& level) const;
  std::string signal_legend() const;
  std::string unit_legend(bool has_candidates) const;

  const ReportData& data_;
  std::vector<MountedUnit> sheet_;
  PlanView view_;
  std::size_t fullest_ = 0;
  SignalScale scale_;
  double radius_;
};

}  // namespace shelfbeam
