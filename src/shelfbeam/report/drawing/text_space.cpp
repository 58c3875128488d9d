#include "shelfbeam/report/drawing/text_space.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

namespace {

bool is_upright_rectangle(const std::vector<Point>& polygon) {
  constexpr double rounding = 0.05;
  if (polygon.size() != 4) return false;
  const Rectangle bounds = Rectangle::around(polygon);
  const auto near = [&](double value, double low, double high) {
    return value < low + rounding || value > high - rounding;
  };
  return std::all_of(polygon.begin(), polygon.end(), [&](const Point& p) {
    return near(p.x, bounds.left, bounds.right) && near(p.y, bounds.top, bounds.bottom);
  });
}

std::vector<Vec2> in_plan(std::span<const Point> points) {
  std::vector<Vec2> polygon;
  for (const Point& p : points) polygon.push_back({p.x, p.y});
  return polygon;
}

std::array<Point, 4> corners_of(const Rectangle& r) {
  return {{{r.left, r.top}, {r.right, r.top}, {r.right, r.bottom}, {r.left, r.bottom}}};
}

// Whether a line from a to b passes through a rectangle.
bool passes(const Rectangle& r, const Point& a, const Point& b) {
  double begin = 0, end = 1;
  const auto clip = [&](double from, double by, double low, double high) {
    if (by == 0) {
      if (from <= low || from >= high) end = -1;
      return;
    }
    const double s = (low - from) / by, t = (high - from) / by;
    begin = std::max(begin, std::min(s, t));
    end = std::min(end, std::max(s, t));
  };
  clip(a.x, b.x - a.x, r.left, r.right);
  clip(a.y, b.y - a.y, r.top, r.bottom);
  return begin < end;
}

bool is_crossed(const Rectangle& text, std::span<const Point> polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k)
    if (passes(text, polygon[k], polygon[(k + 1) % polygon.size()])) return true;
  return false;
}

}  // namespace

Rectangle Rectangle::around(std::span<const Point> points) {
  if (points.empty()) return {};
  Rectangle r{points[0].x, points[0].y, points[0].x, points[0].y};
  for (const Point& p : points)
    r = {std::min(r.left, p.x), std::min(r.top, p.y), std::max(r.right, p.x), std::max(r.bottom, p.y)};
  return r;
}

Obstacle::Obstacle(std::vector<Point> polygon) : bounds_(Rectangle::around(polygon)) {
  if (!is_upright_rectangle(polygon)) polygon_ = std::move(polygon);
}

bool Obstacle::meets(const Rectangle& text) const {
  if (!bounds_.meets(text)) return false;
  if (polygon_.empty() || is_crossed(text, polygon_)) return true;
  const Point middle = text.centre();
  return contains(in_plan(polygon_), {middle.x, middle.y});
}

bool lies_within(const Rectangle& text, std::span<const Point> polygon) {
  if (is_crossed(text, polygon)) return false;
  const std::vector<Vec2> plan = in_plan(polygon);
  const auto corners = corners_of(text);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const Point& corner) { return contains(plan, {corner.x, corner.y}); });
}

double text_width(const std::string& text, double size) {
  constexpr double glyph = 0.62;  // width of a bold sans-serif letter over the font size
  return glyph * size * static_cast<double>(text.size());
}

}  // namespace shelfbeam
