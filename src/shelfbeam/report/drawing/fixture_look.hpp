#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/place/look.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Whether the fixture has an area in plan or is an upright panel, which is a line.
bool has_plan(const FixtureOutline& fixture);

/// Fixtures that have a plan, without inner walls, in the order in which they are drawn: by their tops,
/// lowest first.
std::vector<std::uint32_t> fixtures_by_height(const Scene& scene);

/// The height of horizontal sections above the floor, m.
inline constexpr double section_height = 1.2;

/// The section through the meshes of a fixture at `section_height` or, if they do not extend to that height,
/// halfway up: SVG path data of lines, such as the two faces of a wall. Also the line of an upright panel.
/// Empty for other fixtures.
std::string mesh_section(const PlanView& view, const Scene& scene, std::uint32_t fixture);

}  // namespace shelfbeam
