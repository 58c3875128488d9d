#pragma once

#include <span>
#include <string>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Footprints of all fixtures in plain colours, a background for what stands in front of them.
void draw_fixtures(SvgCanvas& canvas, const PlanView& view, const Scene& scene);

/// A small cross for every mounting point of which no candidate is taken, however many it has; as one path.
void draw_free_points(SvgCanvas& canvas, const PlanView& view, std::span<const Vec3> candidates,
                      const std::vector<bool>& taken);

/// Path data of a line from `at` the way a unit looks that does not look down, the longer the more it leans;
/// empty if it does.
std::string aim_line(const Point& at, const Vec3& axis);

/// How far a label's mark reaches on the plan, from the usual distance between neighbours in a row; units.
double label_mark_radius(const PlanView& view, std::span<const Vec3> positions);

/// Where the marks of labels go: pushed out of the fixture that carries them by their radius; labels above
/// one another stand in line in front of it.
std::vector<Point> label_mark_places(const PlanView& view, std::span<const Vec3> positions,
                                     std::span<const Vec3> normals, double radius);

/// The fixtures' ids, along their long sides. What is too small to hold its id has it beside, clear of other
/// fixtures, ids and the marks of labels; where nothing is free near by, farther off with a line to it.
void draw_fixture_ids(SvgCanvas& canvas, const PlanView& view, const Scene& scene);

}  // namespace shelfbeam
