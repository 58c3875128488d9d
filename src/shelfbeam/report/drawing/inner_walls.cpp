#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/wall_section.hpp"

namespace shelfbeam {

namespace {

std::string path_of(const PlanView& view, std::span<const Polygon> loops) {
  std::string data;
  for (const Polygon& loop : loops) data += path_through(view.outline(loop));
  return data;
}

void draw_panes(SvgCanvas& canvas, const PlanView& view, const InnerWall& wall) {
  const double x = (wall.to[0] - wall.from[0]) / wall.length(),
               y = (wall.to[1] - wall.from[1]) / wall.length();
  for (const WallOpening& opening : wall.openings) {
    if (!opening.has_pane || !is_open_at(opening, section_height)) continue;
    const double end = opening.at + opening.width;
    canvas.line(view.at(wall.from[0] + opening.at * x, wall.from[1] + opening.at * y),
                view.at(wall.from[0] + end * x, wall.from[1] + end * y), "pane");
  }
}

}  // namespace

void draw_inner_walls(SvgCanvas& canvas, const PlanView& view, const Scene& scene) {
  const Words words = words_of(scene);
  if (!scene.room || scene.room->inner_walls.empty()) return;
  const std::vector<WallSection> sections = wall_sections(*scene.room, section_height);
  if (scene.inner_walls() != sections.size()) return;  // a scene whose fixtures were removed
  const std::size_t first = scene.fixtures.size() - sections.size();
  const auto draw = [&](std::size_t w, std::span<const Polygon> loops, const char* css_class) {
    const FixtureOutline& fixture = scene.fixtures[first + w];
    if (!loops.empty()) canvas.path(path_of(view, loops), css_class, fixture_title(words, fixture));
  };
  for (std::size_t w = 0; w < sections.size(); ++w) draw(w, sections[w].below, "wall-low");
  for (std::size_t w = 0; w < sections.size(); ++w) draw(w, sections[w].cut, "wall");
  for (const InnerWall& wall : scene.room->inner_walls) draw_panes(canvas, view, wall);
}

}  // namespace shelfbeam
