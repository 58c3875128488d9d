#include "shelfbeam/report/drawing/plan_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/drawing/fixture_look.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/wall_section.hpp"

namespace shelfbeam {

namespace {

constexpr double drawing_width = 1000, drawing_height = 1300;  // drawing units, around the room

// A gap in the line of an outer wall where the opening is at `section_height`, and its pane at any height.
void draw_opening(SvgCanvas& canvas, const PlanView& view, const RoomShape& room, std::size_t wall,
                  const WallOpening& opening) {
  constexpr double half = 2.5, jamb = 5;  // drawing units
  const auto [from, to] = room.along_wall(wall, opening.at, opening.at + opening.width);
  const Vec2 inward = room.wall(wall).inward;
  const Point a = view.at(from[0], from[1]), b = view.at(to[0], to[1]);
  const auto beside = [&](const Point& p, double by) {
    return Point{p.x + by * inward[0], p.y - by * inward[1]};
  };
  if (is_open_at(opening, section_height))
    canvas.polygon(std::array{beside(a, -half), beside(b, -half), beside(b, half), beside(a, half)}, "hole");
  for (const Point& end : {a, b}) canvas.line(beside(end, -jamb), beside(end, jamb), "tick");
  if (opening.has_pane) canvas.line(a, b, "pane");
}

}  // namespace

PlanView::PlanView(const Scene& scene, double top) : words_(words_of(scene)) {
  const auto include = [this](const Vec3& p) {
    x_.add(p.x);
    y_.add(p.y);
  };
  include(scene.room ? scene.room->lower() : scene.lower);
  include(scene.room ? scene.room->upper() : scene.upper);
  for (const Label& label : scene.labels) include(label.position);
  for (const Transceiver& t : scene.transceivers) include(t.position);
  for (Span* span : {&x_, &y_})
    if (span->size() < 1e-3) span->high = span->low + 1;

  scale_ = std::min(drawing_width / x_.size(), drawing_height / y_.size());
  width_ = left + x_.size() * scale_ + right;
  bottom_ = top + y_.size() * scale_;
  height_ = bottom_ + below;
}

std::vector<Point> PlanView::outline(std::span<const std::array<double, 2>> polygon) const {
  std::vector<Point> points;
  for (const auto& [x, y] : polygon) points.push_back(at(x, y));
  return points;
}

void PlanView::draw_floor(SvgCanvas& canvas, const std::optional<RoomShape>& room) const {
  if (!room || room->is_box)
    canvas.rect(at(x_.low, y_.high), x_.size() * scale_, y_.size() * scale_, "floor");
  else
    canvas.polygon(outline(room->outline), "floor");
  if (!room) return;
  for (const Polygon& hole : room->holes) canvas.polygon(outline(hole), "floor hole");
  for (const CeilingZone& zone : room->zones) canvas.polygon(outline(zone.polygon), "zone", zone.id);
  for (const OpeningRow& row : room->openings)
    for (std::size_t k = 0; k < row.count; ++k) draw_opening(canvas, *this, *room, row.wall, row.opening(k));
}

void PlanView::draw_axes(SvgCanvas& canvas) const {
  const double extent = std::max(x_.size(), y_.size());
  const double step = std::max(1.0, round_step(extent / 26));
  const double labelled = round_step(extent / 9);
  const auto is_labelled = [&](double value) {
    return std::abs(value / labelled - std::round(value / labelled)) < 1e-6;
  };
  const auto metres = [&](double value) {
    return words_.fixed(value, std::abs(value - std::round(value)) < 0.05 ? 0 : 1);
  };
  for (const double x : multiples(x_.low, x_.high, step)) {
    const Point p = at(x, y_.low);
    canvas.line(p, {p.x, p.y + (is_labelled(x) ? 8 : 4)}, "tick");
    if (is_labelled(x)) canvas.text({p.x, p.y + 26}, metres(x), "t mid");
  }
  for (const double y : multiples(y_.low, y_.high, step)) {
    const Point p = at(x_.low, y);
    canvas.line(p, {p.x - (is_labelled(y) ? 8 : 4), p.y}, "tick");
    if (is_labelled(y)) canvas.text({p.x - 11, p.y + 5}, metres(y), "t end");
  }

  const double bar = round_step(x_.size() / 8);
  const Point start{left, bottom_ + 58};
  const double half = bar * scale_ / 2;
  canvas.rect(start, half, 7, "bar-full");
  canvas.rect({start.x + half, start.y}, half, 7, "bar-empty");
  canvas.text({start.x + 2 * half + 10, start.y + 9}, words_.say("drawing.scale", metres(bar)), "t");
  canvas.text({width_ - right, start.y + 9}, words_("drawing.axes"), "t end");
}

}  // namespace shelfbeam
