#include "shelfbeam/report/drawing/wall_elevation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <set>
#include <vector>

#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

// The height of the ceiling along a wall, at these distances from its first corner; a step has both heights.
std::vector<Vec2> ceiling_along(const RoomShape& room, std::size_t wall, double length) {
  constexpr int steps = 1000;
  constexpr double inside = 1e-3, level = 1e-4;  // m
  const Vec2 inward = room.wall(wall).inward;
  std::vector<Vec2> profile;
  for (int k = 0; k < steps; ++k) {
    const double along = length * (k + 0.5) / steps;
    const Vec2 at = room.along_wall(wall, along, along).front();
    const Vec2 p{at[0] + inside * inward[0], at[1] + inside * inward[1]};
    const double height = room.ceiling_over(p).at(p);
    const auto is_level = [&](std::size_t back) {
      return profile.size() >= back && std::abs(profile[profile.size() - back][1] - height) < level;
    };
    if (!is_level(1)) profile.push_back({length * k / steps, height});
    if (is_level(1) && is_level(2)) profile.pop_back();
    profile.push_back({length * (k + 1) / steps, height});
  }
  return profile;
}

double draw_wall(SvgCanvas& canvas, const Words& words, const RoomShape& room, std::size_t wall, double top,
                 double width) {
  constexpr double left = 52, right = 60, heading = 34, below = 34, largest = 60, row = 14;
  const OuterWall outer = room.wall(wall);
  const auto& [from, to, inward] = outer;
  const double length = outer.length();
  const std::vector<Vec2> ceiling = ceiling_along(room, wall, length);
  double highest = 0;
  for (const Vec2& p : ceiling) highest = std::max(highest, p[1]);
  const double scale = std::min((width - left - right) / length, largest);
  const double ground = top + heading + highest * scale;
  // Seen from inside, the first corner is on the right if the inside is to the left of the wall.
  const bool is_reversed = (to[0] - from[0]) * inward[1] - (to[1] - from[1]) * inward[0] > 0;
  const auto at = [&](double along, double z) {
    return Point{left + (is_reversed ? length - along : along) * scale, ground - z * scale};
  };

  canvas.text({left, top + 16}, words.say("drawing.elevation.wall", wall), "title");
  std::vector<Point> outline{at(0, 0)};
  for (const Vec2& p : ceiling) outline.push_back(at(p[0], p[1]));
  outline.push_back(at(length, 0));
  canvas.polygon(outline, "solid");
  std::set<double> heights{0, highest};
  for (const WallOpening& one : room.openings_in(wall)) {
    const double end = one.at + one.width;
    const std::vector<Point> corners{at(one.at, one.bottom), at(end, one.bottom), at(end, one.top),
                                     at(one.at, one.top)};
    canvas.polygon(corners, "hole");
    if (one.has_pane) canvas.polygon(corners, "pane");
    heights.insert({one.bottom, one.top});
  }
  canvas.line({left - 12, ground}, {left + length * scale + 12, ground}, "ground");
  canvas.text({left + length * scale / 2, ground + 21}, words.say("drawing.metres", words.fixed(length, 2)),
              "t mid");
  double last = HUGE_VAL;
  for (const double z : heights) {
    const double y = ground - z * scale;
    canvas.line({left - 10, y}, {left - 3, y}, "tick");
    if (last - y < row) continue;
    canvas.text({left - 14, y + 4}, words.fixed(z, 2), "t end");
    last = y;
  }
  return heading + highest * scale + below;
}

}  // namespace

double draw_wall_elevations(SvgCanvas& canvas, const Scene& scene, double top, double width) {
  if (!scene.room) return 0;
  constexpr double margin = 24;
  const Words words = words_of(scene);
  std::set<std::size_t> walls;
  for (const OpeningRow& row : scene.room->openings) walls.insert(row.wall);
  double height = 0;
  for (const std::size_t wall : walls)
    height += margin + draw_wall(canvas, words, *scene.room, wall, top + height + margin, width);
  return height;
}

}  // namespace shelfbeam
