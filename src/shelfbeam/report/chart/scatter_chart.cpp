#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/chart/svg.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr double side = 440, left_margin = 92, right_margin = 24, top_margin = 20, bottom_margin = 62;
constexpr std::size_t max_bars = 400;  // more error bars hide the dots
constexpr std::size_t many = 2000;     // with more dots, nearly coincident dots are drawn once

struct Kind {
  ScatterChart::Mark mark;
  const char* shape;
  const char* key;
};
constexpr std::array<Kind, 3> kinds{
    {{ScatterChart::Mark::usual, "<circle class=\"m5\" r=\"4\"/>", "scatter.fitted"},
     {ScatterChart::Mark::faint, "<circle class=\"gz\" r=\"4\"/>", "scatter.faint"},
     {ScatterChart::Mark::outlier, "<path class=\"m1\" d=\"M0 -7L6 4H-6Z\"/>", "scatter.outlier"}}};

std::string symbol(ScatterChart::Mark mark) {
  return fmt::format("s{}", static_cast<int>(mark));
}

// Decades; with few decades, also 2 and 5 times each.
std::vector<double> ticks(double low, double high) {
  std::vector<double> result;
  const bool few = high - low < 2.5;
  for (int decade = static_cast<int>(std::floor(low)); decade <= high; ++decade)
    for (const double factor : {1.0, 2.0, 5.0}) {
      const double at = decade + std::log10(factor);
      if ((factor == 1 || few) && at >= low && at <= high) result.push_back(at);
    }
  while (result.size() > 8) {  // every second decade
    std::vector<double> half;
    for (std::size_t k = 0; k < result.size(); k += 2) half.push_back(result[k]);
    result = std::move(half);
  }
  return result;
}

}  // namespace

std::string scatter_svg(const Words& words, const ScatterChart& chart) {
  if (chart.dots.empty()) return {};
  double low = 1e300, high = -1e300;
  for (const auto& dot : chart.dots) {
    low = std::min({low, std::log10(dot.x), std::log10(dot.y)});
    high = std::max({high, std::log10(dot.x), std::log10(dot.y)});
  }
  low -= 0.06 * std::max(high - low, 0.5);
  high += 0.06 * std::max(high - low, 0.5);
  const double unit = side / (high - low);
  const auto x = [&](double decade) { return left_margin + (decade - low) * unit; };
  const auto y = [&](double decade) { return top_margin + side - (decade - low) * unit; };
  const auto inside = [&](double decade) { return std::clamp(decade, low, high); };
  const auto log_or_low = [&](double value) { return value > 0 ? inside(std::log10(value)) : low; };

  SvgCanvas canvas;
  canvas.raw("<defs>");
  for (const Kind& kind : kinds)
    canvas.raw(fmt::format("<g id=\"{}\">{}</g>", symbol(kind.mark), kind.shape));
  canvas.raw("</defs>\n");
  for (const double at : ticks(low, high)) {
    canvas.line({x(at), top_margin}, {x(at), top_margin + side}, "grid");
    canvas.line({left_margin, y(at)}, {left_margin + side, y(at)}, "grid");
    canvas.text({x(at), top_margin + side + 21}, words.plain(std::pow(10, at)), "t mid");
    canvas.text({left_margin - 8, y(at) + 4}, words.plain(std::pow(10, at)), "t end");
  }
  canvas.line({left_margin, top_margin + side}, {left_margin + side, top_margin + side}, "axis");
  canvas.line({left_margin, top_margin}, {left_margin, top_margin + side}, "axis");
  if (chart.dots.size() <= max_bars)
    for (const auto& dot : chart.dots) {
      const double at_x = std::log10(dot.x), at_y = std::log10(dot.y);
      if (dot.x_error > 0)
        canvas.line({x(log_or_low(dot.x - dot.x_error)), y(at_y)},
                    {x(log_or_low(dot.x + dot.x_error)), y(at_y)}, "tick");
      if (dot.y_error > 0)
        canvas.line({x(at_x), y(log_or_low(dot.y - dot.y_error))},
                    {x(at_x), y(log_or_low(dot.y + dot.y_error))}, "tick");
    }
  const double cell = chart.dots.size() > many ? 2.5 : 0.5;
  std::set<std::pair<int, int>> taken;
  const auto draw = [&](ScatterChart::Mark mark) {
    for (const auto& dot : chart.dots) {
      if (dot.mark != mark) continue;
      const Point at{x(std::log10(dot.x)), y(std::log10(dot.y))};
      const bool is_new = taken.emplace(static_cast<int>(at.x / cell), static_cast<int>(at.y / cell)).second;
      if (is_new || mark == ScatterChart::Mark::outlier) canvas.use(symbol(mark), at, dot.title);
    }
  };
  draw(ScatterChart::Mark::faint);
  draw(ScatterChart::Mark::usual);
  canvas.line({x(low), y(low)}, {x(high), y(high)}, "equal");
  if (const double band = chart.band_db / 10; band > 0 && band < high - low)
    for (const double offset : {band, -band}) {
      const double from = std::max(low, low - offset), to = std::min(high, high - offset);
      canvas.line({x(from), y(from + offset)}, {x(to), y(to + offset)}, "mark");
    }
  draw(ScatterChart::Mark::outlier);
  canvas.text({left_margin + side / 2, top_margin + side + 50}, chart.x_title, "t mid");
  canvas.text({16, top_margin + side / 2}, chart.y_title, "t mid", -90);
  return inline_svg(left_margin + side + right_margin, top_margin + side + bottom_margin, "chart",
                    chart.description, canvas.body());
}

std::string scatter_legend(const Words& words, const ScatterChart& chart) {
  std::string items;
  for (const Kind& kind : kinds) {
    const bool occurs = std::any_of(chart.dots.begin(), chart.dots.end(),
                                    [&](const ScatterChart::Dot& dot) { return dot.mark == kind.mark; });
    if (occurs)
      items += fmt::format("<li><svg class=\"key\" viewBox=\"-10 -10 20 20\">{}</svg>{}</li>\n", kind.shape,
                           escape(words(kind.key)));
  }
  return "<ul class=\"legend\">\n" + items + "</ul>\n";
}

}  // namespace shelfbeam
