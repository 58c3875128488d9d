#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/drawing/plan_view.hpp"
#include "shelfbeam/report/drawing/text_space.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// Footprints of all fixtures in plain colours and the inner walls, as a background.
void draw_fixtures(SvgCanvas& canvas, const PlanView& view, const Scene& scene);

/// The tooltip of a fixture: "G3 (gondola, 1.80 m high)".
std::string fixture_title(const Words& words, const FixtureOutline& fixture);

/// The footprint of a fixture; that of an upright panel is a line.
void draw_outline(SvgCanvas& canvas, const PlanView& view, const FixtureOutline& fixture,
                  std::string_view css_class, const std::string& title = {});

/// One small cross per mounting point without a taken candidate, all in one path.
void draw_free_points(SvgCanvas& canvas, const PlanView& view, std::span<const Vec3> candidates,
                      const std::vector<bool>& taken);

/// Path data of a line from `at` in the direction of a unit's axis; its length grows with the tilt. Empty for
/// a unit that points down.
std::string aim_line(const Point& at, const Vec3& axis);

/// Radius of label marks in drawing units, from the median distance between neighbours in a row.
double label_mark_radius(const PlanView& view, std::span<const Vec3> positions);

/// Positions of the label marks: moved out of the fixture by their radius. Labels above one another are drawn
/// in line in front of the fixture.
std::vector<Point> label_mark_positions(const PlanView& view, std::span<const Vec3> positions,
                                        std::span<const Vec3> normals, double radius);

/// The inner walls, cut at `section_height`: solid where they are cut, in outline where only a sill or a low
/// wall is below, open at doors; panes as lines.
void draw_inner_walls(SvgCanvas& canvas, const PlanView& view, const Scene& scene);

/// The id of a zone and the height of its ceiling: "bakery, 2.6 m".
std::string zone_name(const Words& words, const CeilingZone& zone);

/// The ids of the fixtures, along their long sides. The id of a small fixture is drawn beside it, clear of
/// other fixtures, ids and label marks; without free space nearby, farther away with a leader line. The id of
/// a lowered ceiling is drawn in a corner of its outline. Ids on fixtures avoid `marks`, those of units.
/// `referenced` ids are drawn last, with the class "ref" and at least its size. The names of zones are within
/// the zones, where there is space between the fixtures. Adds all of them to `texts`.
void draw_fixture_ids(SvgCanvas& canvas, const PlanView& view, const Scene& scene,
                      std::span<const Point> marks = {}, const std::set<std::string>& referenced = {},
                      std::vector<Obstacle>* texts = nullptr);

}  // namespace shelfbeam
