#include "shelfbeam/report/chart/charts.hpp"

#include <algorithm>
#include <cmath>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double width = 560, left = 86, right = 24, bottom = 62;

// A drawing with two axes: x from `low` to `high`, y from 0 to `highest`.
struct Axes {
  double height, top, low, high, highest;
  double inset = 0;  // free space at both ends of the x axis
  SvgCanvas canvas = {};

  double x(double value) const {
    return left + inset + (value - low) / (high - low) * (width - left - right - 2 * inset);
  }
  double y(double value) const { return height - bottom - value / highest * (height - top - bottom); }

  void draw_height(double value, const std::string& text) {
    if (value > 0) canvas.line({left, y(value)}, {width - right, y(value)}, "grid");
    canvas.text({left - 8, y(value) + 4}, text, "t end");
  }
  void draw_floor() { canvas.line({left, y(0)}, {width - right, y(0)}, "axis"); }
  void draw_tick(double value, const std::string& text) {
    canvas.line({x(value), y(0)}, {x(value), y(0) + 5}, "tick");
    canvas.text({x(value), y(0) + 21}, text, "t mid");
  }
  template <class Chart>
  std::string svg(const Chart& chart) {
    canvas.text({(left + width - right) / 2, height - 12}, chart.x_title, "t mid");
    canvas.text({14, (top + height - bottom) / 2}, chart.y_title, "t mid", -90);
    return inline_svg(width, height, "chart", chart.description, canvas.body());
  }
};

}  // namespace

std::string histogram_svg(const Words& words, const HistogramChart& chart) {
  if (chart.bars.empty()) return {};
  double highest = 1;
  for (const auto& bar : chart.bars) highest = std::max(highest, bar.height);
  const double step = std::max(1.0, round_step(highest / 4.5));
  constexpr double height = 340, top = 34;
  Axes axes{height, top, chart.bars.front().from, chart.bars.back().to, 1.04 * highest};
  SvgCanvas& canvas = axes.canvas;
  const auto x = [&](double value) { return axes.x(value); };
  const double floor = axes.y(0);

  for (const double value : multiples(0, axes.highest, step))
    axes.draw_height(value, words.grouped(static_cast<std::uint64_t>(std::lround(value))));
  for (const auto& bar : chart.bars) {
    if (bar.height <= 0) continue;
    // Even a bar for a single count stays visible.
    const double tall = std::max(floor - axes.y(bar.height), 1.0);
    canvas.rect({x(bar.from) + 0.5, floor - tall}, std::max(x(bar.to) - x(bar.from) - 1, 0.6), tall,
                bar.css_class, bar.title);
  }
  axes.draw_floor();
  for (const auto& tick : chart.ticks) axes.draw_tick(tick.at, tick.text);
  for (const auto& mark : chart.lines) {
    if (mark.at < axes.low || mark.at > axes.high) continue;
    canvas.line({x(mark.at), top - 12}, {x(mark.at), floor}, "mark");
    const bool to_left = x(mark.at) > (left + width) / 2;
    canvas.text({x(mark.at) + (to_left ? -6 : 6), top - 2}, mark.text, to_left ? "t strong end" : "t strong");
  }
  return axes.svg(chart);
}

std::string curve_svg(const Words& words, const CurveChart& chart) {
  if (chart.points.size() < 2) return {};
  const double first = chart.points.front().x, last = chart.points.back().x;
  Axes axes{320, 16, first, last, 100, 10};
  for (const double value : multiples(0, 100, 20)) axes.draw_height(value, words.plain(value));
  axes.draw_floor();
  for (const double value : multiples(first, last, std::max(1.0, round_step((last - first) / 10))))
    axes.draw_tick(value, words.plain(value));
  for (std::size_t k = 1; k < chart.points.size(); ++k) {
    const auto &from = chart.points[k - 1], &to = chart.points[k];
    axes.canvas.line({axes.x(from.x), axes.y(from.high)}, {axes.x(to.x), axes.y(to.high)}, "mark");
    axes.canvas.line({axes.x(from.x), axes.y(from.low)}, {axes.x(to.x), axes.y(to.low)}, "axis");
  }
  const double side = std::clamp((width - left) / static_cast<double>(chart.points.size()) / 2, 2.0, 9.0);
  for (const auto& point : chart.points)
    axes.canvas.rect({axes.x(point.x) - side / 2, axes.y(point.low) - side / 2}, side, side, "m5",
                     point.title);
  return axes.svg(chart);
}

std::string tornado_svg(const Words& words, const TornadoChart& chart) {
  constexpr double left = 20, right = 20, top = 46, bottom = 58, row = 50, thickness = 16;
  if (chart.bars.empty()) return {};
  double low = std::min(chart.middle, chart.limit), high = std::max(chart.middle, chart.limit);
  for (const auto& bar : chart.bars) {
    low = std::min({low, bar.low, bar.high});
    high = std::max({high, bar.low, bar.high});
  }
  const double slack = 0.04 * std::max(high - low, 0.1);
  low -= slack;
  high += slack;
  const double floor = top + row * static_cast<double>(chart.bars.size());
  const auto x = [&](double value) { return left + (value - low) / (high - low) * (width - left - right); };

  SvgCanvas canvas;
  for (const double at : multiples(low, high, round_step((high - low) / 6))) {
    canvas.line({x(at), top}, {x(at), floor}, "grid");
    canvas.text({x(at), floor + 21}, words.plain(at), "t mid");
  }
  canvas.line({left, floor}, {width - right, floor}, "axis");
  // The texts are moved apart if there is space.
  const auto mark = [&](double at, const std::string& text, double height, bool to_left,
                        const char* css_class) {
    canvas.line({x(at), height + 4}, {x(at), floor}, css_class);
    canvas.text({x(at) + (to_left ? -6 : 6), height + 6}, text, to_left ? "t strong end" : "t strong");
  };
  constexpr double widest_text = 170;
  const bool limit_is_left = chart.limit < chart.middle;
  const auto to_left = [&](double at, bool is_right_aligned) {
    return is_right_aligned ? x(at) > widest_text : x(at) > width - widest_text;
  };
  mark(chart.limit, chart.limit_text, 12, to_left(chart.limit, limit_is_left), "mark");
  double y = top;
  for (const auto& bar : chart.bars) {
    const double from = std::min(bar.low, chart.middle), to = std::max(bar.high, chart.middle);
    canvas.rect({x(from), y + 26}, std::max(x(chart.middle) - x(from), 0.6), thickness, "bar short",
                bar.title);
    canvas.rect({x(chart.middle), y + 26}, std::max(x(to) - x(chart.middle), 0.6), thickness, "bar",
                bar.title);
    y += row;
  }
  mark(chart.middle, chart.middle_text, 32, to_left(chart.middle, !limit_is_left), "equal");
  y = top;
  for (const auto& bar : chart.bars) {
    canvas.text({left + 4, y + 18}, bar.name, "t strong");
    y += row;
  }
  canvas.text({(left + width - right) / 2, floor + 46}, chart.x_title, "t mid");
  return inline_svg(width, floor + bottom, "chart", chart.description, canvas.body());
}

}  // namespace shelfbeam
