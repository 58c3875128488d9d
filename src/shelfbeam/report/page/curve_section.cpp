#include <algorithm>

#include <fmt/format.h>

#include "shelfbeam/report/chart/curve_chart.hpp"
#include "shelfbeam/report/messages/selection.hpp"
#include "shelfbeam/report/page/html_table.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

std::string curve_section(const ReportData& data) {
  const std::vector<CurvePoint>& points = data.input.plan.curve.points;
  const std::size_t labels = data.outcome.labels.size();
  if (points.empty() || labels == 0) return {};
  const auto share = [&](std::size_t count) {
    return static_cast<double>(count) / static_cast<double>(labels);
  };
  CurveChart chart;
  chart.description = "Share of the labels that a number of transceivers reaches";
  for (const CurvePoint& point : points)
    chart.points.push_back({static_cast<double>(point.units), 100 * share(point.at_least),
                            100 * share(point.at_most),
                            fmt::format("{}: at least {}, at most {}", counted(point.units, "transceiver"),
                                        percent(share(point.at_least)), percent(share(point.at_most)))});
  chart.x_title = "transceivers";
  chart.y_title = "labels reached (%)";

  constexpr std::size_t most_rows = 20;
  const std::size_t step = (points.size() + most_rows - 1) / most_rows;
  HtmlTable table({{"Transceivers"}, {"Reach at least"}, {"Labels"}, {"Reach at most, proven"}, {"Labels"}});
  for (std::size_t k = (points.size() - 1) % step; k < points.size(); k += step)
    table.add_row({grouped(points[k].units), percent(share(points[k].at_least)), grouped(points[k].at_least),
                   percent(share(points[k].at_most)), grouped(points[k].at_most)});
  std::string note =
      "Some selection of so many of the candidates reaches the one share, none reaches more than the other. "
      "Both are of the simulated matrix; the error of sampling is not part of them.";
  if (!data.input.plan.curve.is_complete) note += fmt::format(" The search {}.", cut_short);
  const std::string text = table.html() + paragraph(note, "note");
  if (points.size() < 2) return html_section("curve", "What fewer transceivers reach", text);
  const std::string picture = html_figure("Labels that fewer transceivers reach", curve_svg(chart),
                                          "Squares: a selection that was found. Dashed: what is proven.");
  return html_section("curve", "What fewer transceivers reach",
                      fmt::format("<div class=\"pair\">\n{}<div>\n{}</div>\n</div>\n", picture, text));
}

}  // namespace shelfbeam
