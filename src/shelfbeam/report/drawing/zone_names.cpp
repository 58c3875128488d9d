#include "shelfbeam/report/drawing/zone_names.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/store_layer.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

// The first position from the top left within the zone; on obstacles only if `covers`.
std::optional<Rectangle> position_within(const std::vector<Point>& zone, double width, double size,
                                         const std::vector<Obstacle>& obstacles, bool covers) {
  constexpr double margin = 6, gap = 3;
  const Rectangle bounds = Rectangle::around(zone);
  const double step = size / 2;
  for (double top = bounds.top + margin; top + size + margin <= bounds.bottom; top += step)
    for (double left = bounds.left + margin; left + width + margin <= bounds.right; left += step) {
      const Rectangle text{left, top, left + width, top + size};
      const Rectangle clear{left - gap, top - gap, text.right + gap, text.bottom + gap};
      const bool is_free = covers || std::none_of(obstacles.begin(), obstacles.end(),
                                                  [&](const Obstacle& o) { return o.meets(clear); });
      if (is_free && lies_within(text, zone)) return text;
    }
  return {};
}

}  // namespace

std::string zone_name(const Words& words, const CeilingZone& zone) {
  double low = zone.height.at(zone.polygon.front()), high = low;
  for (const Vec2& corner : zone.polygon) {
    low = std::min(low, zone.height.at(corner));
    high = std::max(high, zone.height.at(corner));
  }
  constexpr double level = 0.005;  // m
  return high - low < level ? words.say("drawing.zone", zone.id, words.plain(low))
                            : words.say("drawing.sloped_zone", zone.id, words.plain(low), words.plain(high));
}

void draw_zone_names(const Words& words, SvgCanvas& canvas, const PlanView& view, const RoomShape& room,
                     std::vector<Obstacle>& obstacles) {
  for (const CeilingZone& zone : room.zones) {
    const std::string name = zone_name(words, zone);
    const std::vector<Point> outline = view.outline(zone.polygon);
    // The largest size for which there is space; without any, the smallest across fixtures or the border.
    double size = 0;
    std::optional<Rectangle> place;
    for (const double one : {24.0, 20.0, 14.0, 11.0 * view.mark_share()}) {
      if (place) break;
      size = one;
      place = position_within(outline, text_width(name, size), size, obstacles, false);
    }
    if (!place) place = position_within(outline, text_width(name, size), size, obstacles, true);
    if (!place) {
      const Point middle = Rectangle::around(outline).centre();
      const double half = text_width(name, size) / 2;
      place = Rectangle{middle.x - half, middle.y - size / 2, middle.x + half, middle.y + size / 2};
    }
    const Point middle = place->centre();
    canvas.raw(fmt::format("<g style=\"font-size:min(var(--fid,14px),{}px)\">", coordinate(size)));
    canvas.text({middle.x, middle.y + 0.35 * size}, name, "fid mid");
    canvas.raw("</g>");
    obstacles.emplace_back(*place);
  }
}

}  // namespace shelfbeam
