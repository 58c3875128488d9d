#include "shelfbeam/report/drawing/plan_view.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

namespace {

constexpr double drawing_width = 1000, drawing_height = 1300;  // units, the room fits into

}  // namespace

PlanView::PlanView(const Scene& scene, double top) {
  if (scene.room) {
    high_x_ = scene.room->x;
    high_y_ = scene.room->y;
  } else {
    low_x_ = scene.lower.x;
    low_y_ = scene.lower.y;
    high_x_ = scene.upper.x;
    high_y_ = scene.upper.y;
  }
  const auto include = [this](const Vec3& p) {
    low_x_ = std::min(low_x_, p.x);
    high_x_ = std::max(high_x_, p.x);
    low_y_ = std::min(low_y_, p.y);
    high_y_ = std::max(high_y_, p.y);
  };
  for (const Label& label : scene.labels) include(label.position);
  for (const Transceiver& t : scene.transceivers) include(t.position);
  if (high_x_ - low_x_ < 1e-3) high_x_ = low_x_ + 1;
  if (high_y_ - low_y_ < 1e-3) high_y_ = low_y_ + 1;

  scale_ = std::min(drawing_width / (high_x_ - low_x_), drawing_height / (high_y_ - low_y_));
  width_ = left + (high_x_ - low_x_) * scale_ + right;
  bottom_ = top + (high_y_ - low_y_) * scale_;
  height_ = bottom_ + below;
}

std::vector<Point> PlanView::outline(std::span<const std::array<double, 2>> polygon) const {
  std::vector<Point> points;
  for (const auto& [x, y] : polygon) points.push_back(at(x, y));
  return points;
}

void PlanView::draw_floor(SvgCanvas& canvas) const {
  const Point corner = at(low_x_, high_y_);
  canvas.rect(corner, (high_x_ - low_x_) * scale_, (high_y_ - low_y_) * scale_, "floor");
}

void PlanView::draw_axes(SvgCanvas& canvas) const {
  const double extent = std::max(high_x_ - low_x_, high_y_ - low_y_);
  const double step = std::max(1.0, round_step(extent / 26));
  const double labelled = round_step(extent / 9);
  const auto is_labelled = [&](double value) {
    return std::abs(value / labelled - std::round(value / labelled)) < 1e-6;
  };
  const auto metres = [](double value) {
    return fixed(value, std::abs(value - std::round(value)) < 0.05 ? 0 : 1);
  };
  for (const double x : multiples(low_x_, high_x_, step)) {
    const Point p = at(x, low_y_);
    canvas.line(p, {p.x, p.y + (is_labelled(x) ? 8 : 4)}, "tick");
    if (is_labelled(x)) canvas.text({p.x, p.y + 26}, metres(x), "t mid");
  }
  for (const double y : multiples(low_y_, high_y_, step)) {
    const Point p = at(low_x_, y);
    canvas.line(p, {p.x - (is_labelled(y) ? 8 : 4), p.y}, "tick");
    if (is_labelled(y)) canvas.text({p.x - 11, p.y + 5}, metres(y), "t end");
  }

  const double bar = round_step((high_x_ - low_x_) / 8);
  const Point start{left, bottom_ + 58};
  const double half = bar * scale_ / 2;
  canvas.rect(start, half, 7, "bar-full");
  canvas.rect({start.x + half, start.y}, half, 7, "bar-empty");
  canvas.text({start.x + 2 * half + 10, start.y + 9}, metres(bar) + "\u00A0m", "t");
  canvas.text({width_ - right, start.y + 9}, "axes in metres", "t end");
}

}  // namespace shelfbeam
