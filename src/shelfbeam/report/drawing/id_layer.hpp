#pragma once

#include <string_view>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/drawing/text_space.hpp"

namespace shelfbeam {

/// The style of the layer.
inline constexpr std::string_view id_layer_style =
    ".cid{fill:#8a4b00;text-anchor:middle}.face{fill:#1b2228;font-weight:700;text-anchor:middle}\n";

/// A group with the id "ids": the ids of the candidates beside their marks, and N, E, S and W at the faces of
/// columns and inner walls by the compass. No text covers a mark, another text or one of `texts`: it is
/// smaller where space is scarce, and omitted without any. Candidates at one point share a text:
/// "A1-3-2/a1-2" for several axes, otherwise the first id with the number of the others: "G1-3-2 +1".
void draw_id_layer(SvgCanvas& canvas, const PlanView& view, const Scene& scene,
                   const std::vector<Obstacle>& texts);

}  // namespace shelfbeam
