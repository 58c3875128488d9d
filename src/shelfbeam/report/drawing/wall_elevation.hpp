#pragma once

#include <cstddef>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Draws the outer walls with openings as seen from inside, one below the other, from `top` on. Returns their
/// height with the spaces between them: 0 without openings.
double draw_wall_elevations(SvgCanvas& canvas, const Scene& scene, double top, double width);

}  // namespace shelfbeam
