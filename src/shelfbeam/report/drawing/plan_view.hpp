#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/text/words.hpp"
#include "shelfbeam/scene/scene.hpp"

namespace shelfbeam {

/// The range of some values.
struct Span {
  double low = std::numeric_limits<double>::max(), high = -low;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double size() const { return high - low; }
};

/// Maps metres on the floor of a store to a drawing, and draws its frame: room outline, axes, scale bar.
class PlanView {
 public:
  /// Fits the whole scene; leaves `top` drawing units free above it.
  explicit PlanView(const Scene& scene, double top = 12);

  double width() const { return width_; }
  double height() const { return height_; }
  double scale() const { return scale_; }  ///< drawing units per metre
  /// Scale of marks and ids: 1 for rooms of up to about 60 m, smaller for larger rooms.
  double mark_share() const { return std::min(1.0, scale_ / 16); }
  Point at(double x, double y) const {
    return {left + (x - x_.low) * scale_, bottom_ - (y - y_.low) * scale_};
  }
  std::vector<Point> outline(std::span<const std::array<double, 2>> polygon) const;

  void draw_floor(SvgCanvas& canvas, const std::optional<RoomShape>& room) const;
  /// Ticks with metres on both axes and a scale bar.
  void draw_axes(SvgCanvas& canvas) const;

 private:
  static constexpr double left = 52, right = 16, below = 84;

  Words words_;
  Span x_, y_;  // m
  double scale_ = 1, width_ = 0, height_ = 0, bottom_ = 0;
};

}  // namespace shelfbeam
