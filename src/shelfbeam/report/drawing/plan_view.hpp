#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// From the least to the largest of some values.
struct Span {
  double low = std::numeric_limits<double>::max(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return high - low; }
};

/// The mapping from metres of the store's floor to a drawing, with its frame: room outline, axes, scale bar.
class PlanView {
 public:
  /// Fits everything that the scene holds; `top` units are left free above.
  explicit PlanView(const Scene& scene, double top = 12);

  double width() const { return width_; }
  double height() const { return height_; }
  double scale() const { return scale_; }  ///< units per metre
  /// The share of their usual size that marks and ids keep where a metre is small: 1 up to rooms of some 60
  /// m.
  double mark_share() const { return std::min(1.0, scale_ / 16); }
  Point at(double x, double y) const {
    return {left + (x - x_.low) * scale_, bottom_ - (y - y_.low) * scale_};
  }
  std::vector<Point> outline(std::span<const std::array<double, 2>> polygon) const;

  void draw_floor(SvgCanvas& canvas) const;
  /// Ticks with metres on both axes and a scale bar.
  void draw_axes(SvgCanvas& canvas) const;

 private:
  static constexpr double left = 52, right = 16, below = 84;

  Span x_, y_;  // m
  double scale_ = 1, width_ = 0, height_ = 0, bottom_ = 0;
};

}  // namespace shelfbeam
