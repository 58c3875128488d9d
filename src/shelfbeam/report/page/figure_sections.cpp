#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/distributions.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

// The direct share below which a tenth of the labels lies.
std::string lowest_tenth(const Words& words, double direct_share) {
  if (direct_share <= 0) return words.say("reflections.lowest.none");
  if (direct_share < 0.0005) return words.say("reflections.lowest.tiny");
  return words.say("reflections.lowest.some", words.percent(direct_share));
}

std::string excess_figure(const ReportData& data) {
  const ExcessDistribution excess = excess_distribution(data.outcome);
  const auto& [edges, counts, below, above] = excess.percent;
  if (counts.empty()) return {};
  HistogramChart chart;
  chart.description = data.words.say("distributions.excess.description");
  for (std::size_t k = 0; k < counts.size(); ++k)
    chart.bars.push_back(
        {edges[k], edges[k + 1], static_cast<double>(counts[k]), edges[k + 1] <= 0 ? "bar short" : "bar",
         data.words.say("distributions.excess.bar", data.words.plain(edges[k]),
                        data.words.plain(edges[k + 1]), data.words.say_count("noun.label", counts[k]))});
  const double step = round_step((edges.back() - edges.front()) / 6);
  for (const double value : multiples(edges.front(), edges.back(), step))
    chart.ticks.push_back({value, data.words.plain(value)});
  chart.lines.push_back({0, data.words.say("distributions.excess.limit")});
  chart.x_title = data.words.say("distributions.excess.x");
  chart.y_title = data.words.say("distributions.excess.y");
  std::string note = data.words.say("distributions.excess.note", data.words.significant(excess.median),
                                    data.words.significant(excess.mean));
  if (above > 0)
    note += " " + data.words.say_count("distributions.excess.above", above, data.words.plain(edges.back()));
  return html_figure(data.words.say("distributions.excess.title"), histogram_svg(data.words, chart), note);
}

// One line per distinct requirement; with more than four, only the smallest and the largest.
std::vector<HistogramChart::Tick> requirement_lines(const ReportData& data) {
  std::vector<double> values;
  for (const LabelRow& label : data.input.matrix.labels)
    if (label.requirement > 0) values.push_back(label.requirement);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<HistogramChart::Tick> lines;
  lines.reserve(values.size());
  for (const double value : values) lines.push_back({std::log10(value), ""});
  if (lines.size() > 4) lines = {lines.front(), lines.back()};
  if (!lines.empty())
    lines.front().text =
        data.words.say(lines.size() > 1 ? "distributions.signal.limits" : "distributions.signal.limit");
  return lines;
}

std::string matrix_figure(const ReportData& data) {
  const SignalDistribution distribution = signal_distribution(data.input.matrix);
  const auto& [edges, counts, below, above] = distribution.signal;
  if (counts.empty()) return {};
  HistogramChart chart;
  chart.description = data.words.say("distributions.signal.description");
  for (std::size_t k = 0; k < counts.size(); ++k)
    chart.bars.push_back(
        {std::log10(edges[k]), std::log10(edges[k + 1]), static_cast<double>(counts[k]), "bar",
         data.words.say("distributions.signal.bar", data.unit.number(edges[k]), data.unit.text(edges[k + 1]),
                        data.words.say_count("noun.entry", counts[k]))});
  const double low = std::log10(edges.front()), high = std::log10(edges.back());
  for (const double decade : multiples(low, high, high - low > 6 ? 2 : 1)) {
    // The factor of the unit is a power of ten, so decades of the unit and of W/m^2 coincide.
    chart.ticks.push_back({decade, data.words.plain(std::pow(10, decade) / data.unit.factor)});
  }
  chart.lines = requirement_lines(data);
  chart.x_title = data.words.say("distributions.signal.x", data.unit.name);
  chart.y_title = data.words.say("distributions.signal.y");
  std::string note = data.words.say(
      "distributions.signal.note", data.words.grouped(distribution.zeros),
      data.words.say_count("noun.entry", distribution.entries),
      data.words.percent(static_cast<double>(distribution.zeros) /
                         static_cast<double>(std::max<std::uint64_t>(1, distribution.entries))));
  if (below > 0)
    note += " " + data.words.say_count("distributions.signal.below", below, data.unit.text(edges.front()));
  return html_figure(data.words.say("distributions.signal.title"), histogram_svg(data.words, chart), note);
}

// One plan at a time on a screen, all of them on paper: a radio button per level, without a script.
std::string level_switch(const ReportData& data, const Maps& maps) {
  if (data.levels.size() == 1) return maps.margin_map(0);
  std::string buttons, names, plans, rules;
  for (std::size_t k = 0; k < data.levels.size(); ++k) {
    buttons += fmt::format("<input type=\"radio\" name=\"level\" id=\"level-{}\"{}>", k + 1,
                           k == maps.fullest_level() ? " checked=\"checked\"" : "");
    names += fmt::format("<label for=\"level-{0}\">{1}</label>", k + 1,
                         escape(data.words.say("coverage.level", k + 1)));
    plans += maps.margin_map(k);
    rules += fmt::format(
        "#level-{0}:checked~.levels figure:nth-child({0}){{display:block}}"
        "#level-{0}:checked~.tabs label:nth-child({0}){{border-color:var(--accent);color:var(--accent)}}"
        "#level-{0}:focus-visible~.tabs label:nth-child({0}){{outline:2px solid var(--accent)}}\n",
        k + 1);
  }
  return fmt::format(
      "<style>@media screen{{.levels figure{{display:none}}\n{}}}</style>\n<div class=\"switch\">{}"
      "<div class=\"tabs\">{}</div>\n<div class=\"levels\">\n{}</div></div>\n",
      rules, buttons, names, plans);
}

}  // namespace

std::string margin_section(const ReportData& data, const Maps& maps) {
  if (data.levels.empty()) return {};
  std::string html = paragraph(
      data.has_selection() ? data.words.say("coverage.intro")
                           : data.words.say("coverage.intro_maximum", maximum_signal_condition(data)));
  if (const std::size_t count = data.outcome.flagged_labels; count > 0)
    html += paragraph(data.words.say_count("coverage.hollow", count));
  return html_section("plans", data.words.say("coverage.title"), html + level_switch(data, maps));
}

std::string reflection_section(const ReportData& data, const Maps& maps) {
  if (!data.has_selection() || data.levels.empty()) return {};
  const std::string heading = data.words.say("reflections.title");
  if (!data.has_direct())
    return html_section("reflections", heading, paragraph(data.words.say("reflections.missing")));
  const std::size_t level = maps.fullest_level();
  const std::vector<double> shares = data.outcome.direct_shares();
  std::string html = paragraph(data.words.say(
      "reflections.shares", data.words.grouped(data.outcome.met_by_direct_light),
      data.words.say_count("noun.label", data.outcome.labels.size()), data.words.grouped(data.outcome.met),
      data.words.percent(quantile(shares, 0.5)), lowest_tenth(data.words, quantile(shares, 0.1)),
      data.words.percent(quantile(shares, 0.9))));
  html += paragraph(data.words.say("reflections.maps", level + 1, data.levels[level].heights(data.words)));
  html += maps.signal_maps(level);
  return html_section("reflections", heading, html);
}

std::string distribution_section(const ReportData& data) {
  const std::string figures = (data.has_selection() ? excess_figure(data) : "") + matrix_figure(data);
  if (figures.empty()) return {};
  return html_section("distributions", data.words.say("distributions.title"),
                      "<div class=\"pair\">\n" + figures + "</div>\n");
}

std::string curve_section(const ReportData& data) {
  const std::vector<CurvePoint>& points = data.input.plan.curve.points;
  const std::size_t labels = data.outcome.labels.size();
  if (points.empty() || labels == 0) return {};
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(labels);
  };
  const auto at_least = [&](const CurvePoint& point) {
    return data.words.percent(rounded_down(share(point.at_least), 3));
  };
  const auto at_most = [&](const CurvePoint& point) {
    return data.words.percent(rounded_up(share(point.at_most), 3));
  };
  CurveChart chart;
  chart.description = data.words.say("curve.description");
  for (const CurvePoint& point : points)
    chart.points.push_back(
        {static_cast<double>(point.units), 100 * share(point.at_least), 100 * share(point.at_most),
         data.words.say_count("curve.point", point.units, at_least(point), at_most(point))});
  chart.x_title = data.words.say("curve.x");
  chart.y_title = data.words.say("curve.y");

  constexpr std::size_t max_rows = 20;
  const std::size_t step = (points.size() + max_rows - 1) / max_rows;
  HtmlTable table({{data.words.say("curve.units")},
                   {data.words.say("curve.at_least")},
                   {data.words.say("curve.labels")},
                   {data.words.say("curve.at_most")},
                   {data.words.say("curve.labels")}});
  for (std::size_t k = (points.size() - 1) % step; k < points.size(); k += step)
    table.add_row({data.words.grouped(points[k].units), at_least(points[k]),
                   data.words.grouped(points[k].at_least), at_most(points[k]),
                   data.words.grouped(points[k].at_most)});
  std::string note = data.words.say("curve.note");
  if (!data.input.plan.curve.is_complete) note += " " + data.words.say("curve.stopped");
  const std::string text = table.html() + paragraph(note, "note");
  if (points.size() < 2) return html_section("curve", data.words.say("curve.title"), text);
  const std::string picture =
      html_figure(data.words.say("curve.figure"), curve_svg(data.words, chart), data.words.say("curve.key"));
  return html_section("curve", data.words.say("curve.title"),
                      fmt::format("<div class=\"pair\">\n{}<div>\n{}</div>\n</div>\n", picture, text));
}

}  // namespace shelfbeam
