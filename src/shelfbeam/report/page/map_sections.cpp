#include <fmt/format.h>

#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/page/sections.hpp"

namespace shelfbeam {

namespace {

// What the tenth of the labels with the least direct light has of it.
std::string least_tenth(double direct_share) {
  if (direct_share <= 0) return "one in ten gets no direct light";
  if (direct_share < 0.0005) return "one label in ten has less than 0.1\u00A0%";
  return fmt::format("one label in ten has {} or less", percent(direct_share));
}

}  // namespace

std::string margin_section(const ReportData& data, const Maps& maps) {
  if (data.levels.empty()) return {};
  std::string html = paragraph(
      data.has_selection()
          ? "Each mark is a label, on the side it faces. Its colour tells by how many decibels its signal "
            "exceeds what it needs: 3 dB is twice as much, 10 dB ten times. Triangles are labels that are "
            "not "
            "reached. Numbers are the chosen units, as in the table below."
          : fmt::format("Each mark is a label, on the side it faces. Its colour tells how its signal would "
                        "compare to what it needs {}. Triangles are labels that stay out of reach.",
                        everything_on(data)));
  if (const std::size_t count = data.outcome.on_flagged; count > 0)
    html += paragraph(fmt::format(
        "Whether the {} reached depends on signals whose standard error is not to be trusted: few batches of "
        "samples found most of their light. More samples would tell.",
        count == 1 ? "label with a hollow mark is" : grouped(count) + " labels with a hollow mark are"));
  for (std::size_t k = 0; k < data.levels.size(); ++k) html += maps.margin_map(k);
  return html_section("plans", "Floor plan by shelf level", html);
}

std::string reflection_section(const ReportData& data, const Maps& maps) {
  if (!data.has_selection() || data.levels.empty()) return {};
  constexpr const char* heading = "What reflections add";
  if (!data.has_direct())
    return html_section("reflections", heading,
                        paragraph("The signal matrix does not tell direct from reflected light."));
  const std::size_t level = maps.fullest_level();
  const std::vector<double> shares = data.outcome.direct_shares();
  std::string html =
      paragraph(fmt::format("By direct light alone, {} of {} would be reached; with the light that floor, "
                            "ceiling, shelves and goods throw back, {} are. The direct share of a label's "
                            "signal has the median {}; {}, one in ten has {} or more.",
                            grouped(data.outcome.met_by_direct), counted(data.outcome.labels.size(), "label"),
                            grouped(data.outcome.met), percent(quantile(shares, 0.5)),
                            least_tenth(quantile(shares, 0.1)), percent(quantile(shares, 0.9))));
  html += paragraph(fmt::format("Signal of the chosen units at level {}, {}, both in one logarithmic scale:",
                                level + 1, data.levels[level].heights()));
  html += maps.signal_maps(level);
  return html_section("reflections", heading, html);
}

}  // namespace shelfbeam
