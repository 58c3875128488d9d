#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/distributions.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

namespace {

// The direct share below which a tenth of the labels lies.
std::string lowest_tenth(double direct_share) {
  if (direct_share <= 0) return "one label in ten receives no direct light";
  if (direct_share < 0.0005) return "one label in ten has less than 0.1\u00A0%";
  return fmt::format("one label in ten has {} or less", percent(direct_share));
}

std::string excess_figure(const ReportData& data) {
  const ExcessDistribution excess = excess_distribution(data.outcome);
  const auto& [edges, counts, below, above] = excess.percent;
  if (counts.empty()) return {};
  HistogramChart chart;
  chart.description = "Histogram of the excess signal of all labels";
  for (std::size_t k = 0; k < counts.size(); ++k)
    chart.bars.push_back({edges[k], edges[k + 1], static_cast<double>(counts[k]),
                          edges[k + 1] <= 0 ? "bar short" : "bar",
                          fmt::format("{} to {}\u00A0%: {}", plain(edges[k]), plain(edges[k + 1]),
                                      counted(counts[k], "label"))});
  const double step = round_step((edges.back() - edges.front()) / 6);
  for (const double value : multiples(edges.front(), edges.back(), step))
    chart.ticks.push_back({value, plain(value)});
  chart.lines.push_back({0, "requirement"});
  chart.x_title = "excess signal (% of the requirement)";
  chart.y_title = "labels";
  std::string note =
      fmt::format("Median {}\u00A0%, mean {}\u00A0%.", significant(excess.median), significant(excess.mean));
  if (above > 0)
    note += fmt::format(" {} above {}\u00A0% {} not drawn.", counted(above, "label"), plain(edges.back()),
                        above == 1 ? "is" : "are");
  return html_figure("Excess signal of the labels", histogram_svg(chart), note);
}

// One line per distinct requirement; with more than four, only the smallest and the largest.
std::vector<HistogramChart::Tick> requirement_lines(const ReportData& data) {
  std::vector<double> values;
  for (const LabelRow& label : data.input.matrix.labels)
    if (label.requirement > 0) values.push_back(label.requirement);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  std::vector<HistogramChart::Tick> lines;
  for (const double value : values) lines.push_back({std::log10(value), ""});
  if (lines.size() > 4) lines = {lines.front(), lines.back()};
  if (!lines.empty()) lines.front().text = lines.size() > 1 ? "requirements" : "requirement";
  return lines;
}

std::string matrix_figure(const ReportData& data) {
  const SignalDistribution distribution = signal_distribution(data.input.matrix);
  const auto& [edges, counts, below, above] = distribution.signal;
  if (counts.empty()) return {};
  HistogramChart chart;
  chart.description = "Histogram of all entries of the signal matrix on a logarithmic scale";
  for (std::size_t k = 0; k < counts.size(); ++k)
    chart.bars.push_back({std::log10(edges[k]), std::log10(edges[k + 1]), static_cast<double>(counts[k]),
                          "bar",
                          fmt::format("{} to {}: {}", data.unit.number(edges[k]),
                                      data.unit.text(edges[k + 1]), counted(counts[k], "entry", "entries"))});
  const double low = std::log10(edges.front()), high = std::log10(edges.back());
  for (const double decade : multiples(low, high, high - low > 6 ? 2 : 1)) {
    // The factor of the unit is a power of ten, so decades of the unit and of W/m^2 coincide.
    chart.ticks.push_back({decade, plain(std::pow(10, decade) / data.unit.factor)});
  }
  chart.lines = requirement_lines(data);
  chart.x_title = fmt::format("signal of one unit at one label ({})", data.unit.name);
  chart.y_title = "entries";
  std::string note =
      fmt::format("{} of {} ({}) are zero or, because of noise, negative; these are not drawn.",
                  grouped(distribution.zeros), counted(distribution.entries, "entry", "entries"),
                  percent(static_cast<double>(distribution.zeros) /
                          static_cast<double>(std::max<std::uint64_t>(1, distribution.entries))));
  if (below > 0)
    note += fmt::format(" {} below {} {} not drawn.", counted(below, "entry", "entries"),
                        data.unit.text(edges.front()), below == 1 ? "is" : "are");
  return html_figure("Signal of every candidate at every label", histogram_svg(chart), note);
}

}  // namespace

std::string margin_section(const ReportData& data, const Maps& maps) {
  if (data.levels.empty()) return {};
  std::string html = paragraph(
      data.has_selection()
          ? "Each mark is a label, drawn on the side that the label faces. Its colour shows the margin in "
            "decibels: at 3 dB the signal is twice the requirement, at 10 dB ten times. Triangles "
            "are labels that are not reached. Numbers mark the chosen units, as in the table below."
          : fmt::format(
                "Each mark is a label, drawn on the side that the label faces. Its colour compares the "
                "requirement with the signal that the label would receive {}. Triangles are labels "
                "that no selection reaches.",
                maximum_signal_condition(data)));
  if (const std::size_t count = data.outcome.flagged_labels; count > 0)
    html += paragraph(fmt::format(
        "The {} on signals with an unreliable standard error: few batches of samples found most of their "
        "light. Use more samples to decide.",
        count == 1 ? "label with a hollow mark depends"
                   : grouped(count) + " labels with a hollow mark depend"));
  for (std::size_t k = 0; k < data.levels.size(); ++k) html += maps.margin_map(k);
  return html_section("plans", "Floor plan by shelf level", html);
}

std::string reflection_section(const ReportData& data, const Maps& maps) {
  if (!data.has_selection() || data.levels.empty()) return {};
  constexpr const char* heading = "Contribution of reflections";
  if (!data.has_direct())
    return html_section("reflections", heading,
                        paragraph("The signal matrix does not separate direct from reflected light."));
  const std::size_t level = maps.fullest_level();
  const std::vector<double> shares = data.outcome.direct_shares();
  std::string html = paragraph(
      fmt::format("Direct light alone would reach {} of {}; with reflections from floor, ceiling, "
                  "shelves and goods, {} are reached. The median direct share of a label's signal "
                  "is {}; {}, one label in ten has {} or more.",
                  grouped(data.outcome.met_by_direct_light), counted(data.outcome.labels.size(), "label"),
                  grouped(data.outcome.met), percent(quantile(shares, 0.5)),
                  lowest_tenth(quantile(shares, 0.1)), percent(quantile(shares, 0.9))));
  html += paragraph(fmt::format(
      "Signal of the chosen units at level {}, {}; both maps use the same logarithmic scale:", level + 1,
      data.levels[level].heights()));
  html += maps.signal_maps(level);
  return html_section("reflections", heading, html);
}

std::string distribution_section(const ReportData& data) {
  const std::string figures = (data.has_selection() ? excess_figure(data) : "") + matrix_figure(data);
  if (figures.empty()) return {};
  return html_section("distributions", "Distribution of the signal",
                      "<div class=\"pair\">\n" + figures + "</div>\n");
}

std::string curve_section(const ReportData& data) {
  const std::vector<CurvePoint>& points = data.input.plan.curve.points;
  const std::size_t labels = data.outcome.labels.size();
  if (points.empty() || labels == 0) return {};
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(labels);
  };
  CurveChart chart;
  chart.description = "Share of the labels reached, by number of transceivers";
  for (const CurvePoint& point : points)
    chart.points.push_back({static_cast<double>(point.units), 100 * share(point.at_least),
                            100 * share(point.at_most),
                            fmt::format("{}: at least {}, at most {}", counted(point.units, "transceiver"),
                                        percent(share(point.at_least)), percent(share(point.at_most)))});
  chart.x_title = "transceivers";
  chart.y_title = "labels reached (%)";

  constexpr std::size_t max_rows = 20;
  const std::size_t step = (points.size() + max_rows - 1) / max_rows;
  HtmlTable table(
      {{"Transceivers"}, {"Reached at least"}, {"Labels"}, {"Reached at most, proven"}, {"Labels"}});
  for (std::size_t k = (points.size() - 1) % step; k < points.size(); k += step)
    table.add_row({grouped(points[k].units), percent(share(points[k].at_least)), grouped(points[k].at_least),
                   percent(share(points[k].at_most)), grouped(points[k].at_most)});
  std::string note =
      "For each number of transceivers, a selection reaches the first share, and no selection reaches more "
      "than the second share. Both shares apply to the simulated signals, without their sampling error.";
  if (!data.input.plan.curve.is_complete) note += fmt::format(" The search {}.", stopped_early_note);
  const std::string text = table.html() + paragraph(note, "note");
  if (points.size() < 2) return html_section("curve", "Coverage with fewer transceivers", text);
  const std::string picture = html_figure("Labels reached by fewer transceivers", curve_svg(chart),
                                          "Squares: selections found. Dashed line: proven upper bound.");
  return html_section("curve", "Coverage with fewer transceivers",
                      fmt::format("<div class=\"pair\">\n{}<div>\n{}</div>\n</div>\n", picture, text));
}

}  // namespace shelfbeam
