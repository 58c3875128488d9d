#pragma once

#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/drawing/text_space.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

/// The names of the zones of a room, within the zones, where no obstacle is. Adds them to the obstacles.
void draw_zone_names(const Words& words, SvgCanvas& canvas, const PlanView& view, const RoomShape& room,
                     std::vector<Obstacle>& obstacles);

}  // namespace shelfbeam
