#pragma once

#include <cstdint>
#include <optional>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The fixture that carries most labels: those within 0.1 m of its outline and no higher than it. Nothing
/// where no fixture carries any.
std::optional<std::uint32_t> fixture_with_most_labels(const Scene& scene);

/// Side view of one fixture from the face with most labels, and its end view beside it: what stands nearer
/// hides what is behind. Draws below `top` into `width` units and returns the height it took.
double draw_elevation(SvgCanvas& canvas, const Scene& scene, std::uint32_t fixture, double top, double width);

}  // namespace shelfbeam
