#pragma once

#include <string>
#include <vector>

#include "shelfbeam/math/vec3.hpp"
#include "shelfbeam/plan/answer/availability.hpp"
#include "shelfbeam/plan/answer/certified_plan.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

namespace shelfbeam {

/// A state of a shop that changes, as the 3-D view draws it.
struct ShopState {
  /// A person or an object.
  struct Block {
    std::vector<Vec2> footprint;  ///< counter-clockwise polygon in plan, m
    double bottom = 0, top = 0;   ///< m
  };

  ShownState verdicts;
  std::vector<Block> blocks;
  std::vector<std::string> open_doors;  ///< ids of fixtures
};

/// The input of a report, which is the source of every number in it.
struct ReportInput {
  const Scene& scene;
  const SignalMatrix& matrix;
  const CertifiedPlan& plan;
  /// Whether texts in CSV files have an apostrophe where a spreadsheet would take them for formulas.
  bool safe_csv = false;
  /// Those of Availability::shown.
  std::vector<ShopState> states = {};
};

/// A self-contained HTML page that needs no network and, apart from the 3-D view, no script.
std::string report_html(const ReportInput& input);

/// The floor plan as SVG: room, fixtures with their parts, labels, candidate transceivers. With ids, it has a
/// layer with those of the candidates and with the faces of columns.
std::string floor_plan_svg(const Scene& scene, bool with_ids = false);

/// labels.csv: one row per label with signal, requirement, margin and serving units.
std::string labels_csv(const ReportInput& input);

/// placement.csv: one row per chosen unit with the columns of the transceiver CSV and numbers of labels.
std::string placement_csv(const ReportInput& input);

/// bill.csv: one row per type and price of the chosen units, with quantities.
std::string bill_csv(const ReportInput& input);

/// mounting.csv: one row per chosen unit in walking order, with its distances to walls or fixtures.
std::string mounting_csv(const ReportInput& input);

/// mounting.dxf: the chosen units as numbered blocks on a layer of their own, and the outlines of room and
/// fixtures on another, in m.
std::string mounting_dxf(const ReportInput& input);

}  // namespace shelfbeam
