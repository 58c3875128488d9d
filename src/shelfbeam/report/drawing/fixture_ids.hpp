#pragma once

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The fixtures' ids, along their long sides. What is too small to hold its id has it beside, clear of other
/// fixtures, ids and the marks of labels; where nothing is free near by, farther off with a line to it.
void draw_fixture_ids(SvgCanvas& canvas, const PlanView& view, const Scene& scene);

}  // namespace shelfbeam
