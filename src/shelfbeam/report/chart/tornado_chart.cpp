#include "shelfbeam/report/chart/tornado_chart.hpp"

#include <algorithm>

#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {

namespace {

constexpr double width = 560, left = 20, right = 20, top = 46, bottom = 58;
constexpr double row = 50, thickness = 16;

}  // namespace

std::string tornado_svg(const TornadoChart& chart) {
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
    canvas.text({x(at), floor + 21}, plain(at), "t mid");
  }
  canvas.line({left, floor}, {width - right, floor}, "axis");
  // The texts stand away from each other where there is room.
  const auto mark = [&](double at, const std::string& text, double height, bool to_left,
                        const char* css_class) {
    canvas.line({x(at), height + 4}, {x(at), floor}, css_class);
    canvas.text({x(at) + (to_left ? -6 : 6), height + 6}, text, to_left ? "t strong end" : "t strong");
  };
  constexpr double widest_text = 170;
  const bool limit_is_left = chart.limit < chart.middle;
  const auto to_left = [&](double at, bool wanted) {
    return wanted ? x(at) > widest_text : x(at) > width - widest_text;
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
