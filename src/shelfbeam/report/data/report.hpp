#pragma once

#include <string>

#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// What a report is made of; it holds no number that is not in one of these.
struct ReportInput {
  const Scene& scene;
  const SignalMatrix& matrix;
  const CertifiedPlan& plan;
};

/// A self-contained HTML page (no scripts needed to read it, no network).
std::string report_html(const ReportInput& input);

/// The floor plan as SVG: room, fixtures with their parts, labels, candidate transceivers.
std::string floor_plan_svg(const Scene& scene);

/// labels.csv: one row a label with its signal under the placement, requirement, margin and serving units.
std::string labels_csv(const ReportInput& input);

/// placement.csv: one row a chosen unit, in the columns of the transceiver CSV, and how many
/// labels it serves.
std::string placement_csv(const ReportInput& input);

}  // namespace shelfbeam
