#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The mapping from metres of the store's floor to a drawing, with its frame: room outline, axes, scale bar.
class PlanView {
 public:
  /// Fits everything that the scene holds; `top` units are left free above.
  explicit PlanView(const Scene& scene, double top = 12);

  double width() const { return width_; }
  double height() const { return height_; }
  double scale() const { return scale_; }  ///< units per metre
  /// The share of their usual size that marks and ids keep where a metre is small: 1 up to rooms of about 60
  /// m.
  double mark_share() const { return std::min(1.0, scale_ / 16); }
  Point at(double x, double y) const {
    return {left + (x - low_x_) * scale_, bottom_ - (y - low_y_) * scale_};
  }
  std::vector<Point> outline(std::span<const std::array<double, 2>> polygon) const;

  void draw_floor(SvgCanvas& canvas) const;
  /// Ticks with metres on both axes and a scale bar.
  void draw_axes(SvgCanvas& canvas) const;

 private:
  static constexpr double left = 52, right = 16, below = 84;

  double low_x_ = 0, low_y_ = 0, high_x_ = 1, high_y_ = 1;  // m
  double scale_ = 1, width_ = 0, height_ = 0, bottom_ = 0;
};

}  // namespace shelfbeam
