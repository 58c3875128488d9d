#include "shelfbeam/report/chart/histogram_chart.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

namespace {

constexpr double width = 560, height = 340, left = 86, right = 24, top = 34, bottom = 62;

}  // namespace

std::string histogram_svg(const HistogramChart& chart) {
  if (chart.bars.empty()) return {};
  const double low = chart.bars.front().from, high = chart.bars.back().to;
  double most = 1;
  for (const auto& bar : chart.bars) most = std::max(most, bar.height);
  const double step = std::max(1.0, round_step(most / 4.5));
  most *= 1.04;
  const auto x = [&](double value) { return left + (value - low) / (high - low) * (width - left - right); };
  const auto y = [&](double value) { return height - bottom - value / most * (height - top - bottom); };

  SvgCanvas canvas;
  for (const double value : multiples(0, most, step)) {
    if (value > 0) canvas.line({left, y(value)}, {width - right, y(value)}, "grid");
    canvas.text({left - 8, y(value) + 4}, grouped(static_cast<std::uint64_t>(std::lround(value))), "t end");
  }
  for (const auto& bar : chart.bars) {
    if (bar.height <= 0) continue;
    // A bar of a single count among many stays visible.
    const double tall = std::max(y(0) - y(bar.height), 1.0);
    canvas.rect({x(bar.from) + 0.5, y(0) - tall}, std::max(x(bar.to) - x(bar.from) - 1, 0.6), tall,
                bar.css_class, bar.title);
  }
  canvas.line({left, y(0)}, {width - right, y(0)}, "axis");
  for (const auto& tick : chart.ticks) {
    canvas.line({x(tick.at), y(0)}, {x(tick.at), y(0) + 5}, "tick");
    canvas.text({x(tick.at), y(0) + 21}, tick.text, "t mid");
  }
  for (const auto& mark : chart.lines) {
    if (mark.at < low || mark.at > high) continue;
    canvas.line({x(mark.at), top - 12}, {x(mark.at), y(0)}, "mark");
    const bool to_left = x(mark.at) > (left + width) / 2;
    canvas.text({x(mark.at) + (to_left ? -6 : 6), top - 2}, mark.text, to_left ? "t strong end" : "t strong");
  }
  canvas.text({(left + width - right) / 2, height - 12}, chart.x_title, "t mid");
  canvas.text({14, (top + height - bottom) / 2}, chart.y_title, "t mid", -90);
  return inline_svg(width, height, "chart", chart.description, canvas.body());
}

}  // namespace shelfbeam
