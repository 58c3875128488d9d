#pragma once

#include <cstdint>
#include <string>

#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// What a part that is a mesh covers of the plan, as SVG path data: its triangles, all turned the same way,
/// so that filling leaves no holes where they overlap. A stroke painted before the fill (`paint-order`) shows
/// on the outline alone. Empty for what is no mesh, stands upright, or has more triangles than a drawing
/// should hold; the part's footprint stands for it then.
std::string mesh_silhouette(const PlanView& view, const Scene& scene, const Part& part);

/// That of all parts of a fixture; empty unless every one that covers something has one.
std::string mesh_silhouette(const PlanView& view, const Scene& scene, std::uint32_t fixture);

}  // namespace shelfbeam
