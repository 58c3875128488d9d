#pragma once

#include <span>
#include <string>
#include <vector>

#include "shelfbeam/report/drawing/plan_view.hpp"

namespace shelfbeam {

/// An upright rectangle of a drawing.
struct Rectangle {
  double left = 0, top = 0, right = 0, bottom = 0;

  bool meets(const Rectangle& o) const {
    return left < o.right && o.left < right && top < o.bottom && o.top < bottom;
  }
  Point centre() const { return {(left + right) / 2, (top + bottom) / 2}; }
  static Rectangle around(std::span<const Point> points);
};

/// An area that a text must not cover.
class Obstacle {
 public:
  explicit Obstacle(const Rectangle& rectangle) : bounds_(rectangle) {}
  explicit Obstacle(std::vector<Point> polygon);

  bool meets(const Rectangle& text) const;
  const Rectangle& bounds() const { return bounds_; }

 private:
  Rectangle bounds_;
  std::vector<Point> polygon_;  ///< empty for a rectangle
};

/// Whether a rectangle lies within a polygon.
bool lies_within(const Rectangle& text, std::span<const Point> polygon);

/// The estimated width of a text, bold and sans-serif.
double text_width(const std::string& text, double size);

}  // namespace shelfbeam
