#include "shelfbeam/report/drawing/plan_view.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double drawing_width = 1000, drawing_height = 1300;  // drawing units, around the room

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
