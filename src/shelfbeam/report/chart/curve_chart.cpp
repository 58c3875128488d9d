#include "shelfbeam/report/chart/curve_chart.hpp"

#include <algorithm>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

namespace {

constexpr double width = 560, height = 320, left = 86, right = 24, top = 16, bottom = 62;

}  // namespace

std::string curve_svg(const CurveChart& chart) {
  if (chart.points.size() < 2) return {};
  const double first = chart.points.front().x, last = chart.points.back().x;
  const auto x = [&](double value) {
    return left + 10 + (value - first) / (last - first) * (width - left - right - 20);
  };
  const auto y = [&](double value) { return height - bottom - value / 100 * (height - top - bottom); };

  SvgCanvas canvas;
  for (const double value : multiples(0, 100, 20)) {
    if (value > 0) canvas.line({left, y(value)}, {width - right, y(value)}, "grid");
    canvas.text({left - 8, y(value) + 4}, plain(value), "t end");
  }
  canvas.line({left, y(0)}, {width - right, y(0)}, "axis");
  for (const double value : multiples(first, last, std::max(1.0, round_step((last - first) / 10)))) {
    canvas.line({x(value), y(0)}, {x(value), y(0) + 5}, "tick");
    canvas.text({x(value), y(0) + 21}, plain(value), "t mid");
  }
  for (std::size_t k = 1; k < chart.points.size(); ++k) {
    const auto &from = chart.points[k - 1], &to = chart.points[k];
    canvas.line({x(from.x), y(from.high)}, {x(to.x), y(to.high)}, "mark");
    canvas.line({x(from.x), y(from.low)}, {x(to.x), y(to.low)}, "axis");
  }
  const double side = std::clamp((width - left) / static_cast<double>(chart.points.size()) / 2, 2.0, 9.0);
  for (const auto& point : chart.points)
    canvas.rect({x(point.x) - side / 2, y(point.low) - side / 2}, side, side, "m5", point.title);
  canvas.text({(left + width - right) / 2, height - 12}, chart.x_title, "t mid");
  canvas.text({14, (top + height - bottom) / 2}, chart.y_title, "t mid", -90);
  return inline_svg(width, height, "chart", chart.description, canvas.body());
}

}  // namespace shelfbeam
