#include "shelfbeam/report/comparison/comparison_report.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "shelfbeam/base/csv.hpp"
#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/scale.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/comparison.hpp"
#include "shelfbeam/report/page/html.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {

namespace {

constexpr std::size_t max_compared = 20;

const char* use_name(PairUse use) {
  constexpr const char* names[] = {"fitted", "uncertain", "nothing-measured"};
  return names[static_cast<std::size_t>(use)];
}

std::string residual_text(const Words& words, const PairResult& result) {
  return result.residual ? words.decibels(*result.residual) : "–";
}

// Measured signals are divided by the factor, so that agreeing signals lie on the diagonal.
std::string scatter_figure(const Words& words, const ComparisonInput& input) {
  const Comparison& comparison = input.comparison;
  std::vector<double> values;
  for (const ComparedPair& pair : input.pairs)
    if (pair.simulated > 0) values.push_back(pair.simulated);
  std::sort(values.begin(), values.end());
  const SignalUnit unit = signal_unit(words, values[values.size() / 2]);
  ScatterChart chart;
  chart.description = words.say("comparison.signals.description");
  chart.band_db = comparison.residual_quantile_90;
  chart.x_title = words.say("comparison.signals.x", unit.name);
  chart.y_title = words.say("comparison.signals.y", words.significant(comparison.factor), unit.name);
  std::size_t absent = 0;
  for (std::size_t k = 0; k < input.pairs.size(); ++k) {
    const ComparedPair& pair = input.pairs[k];
    const PairResult& result = comparison.pairs[k];
    if (!result.residual) {
      ++absent;
      continue;
    }
    const double scaled = pair.measured / comparison.factor;
    const auto mark = result.outlier                  ? ScatterChart::Mark::outlier
                      : result.use == PairUse::fitted ? ScatterChart::Mark::usual
                                                      : ScatterChart::Mark::faint;
    chart.dots.push_back(
        {pair.simulated / unit.factor, scaled / unit.factor, pair.standard_error / unit.factor,
         pair.error.value_or(0) / comparison.factor / unit.factor, mark,
         words.say("comparison.signals.dot", pair_name(words, input.matrix, pair), unit.text(pair.simulated),
                   unit.text(scaled), words.decibels(*result.residual))});
  }
  std::string note = words.say("comparison.signals.note", words.fixed(comparison.residual_quantile_90, 2));
  if (absent > 0) note += " " + words.say_count("comparison.signals.absent", absent);
  return html_figure(words.say("comparison.signals.figure"),
                     scatter_svg(words, chart) + scatter_legend(words, chart), note);
}

std::string residual_figure(const Words& words, const Comparison& comparison) {
  std::vector<double> residuals;  // without outliers, whose range would squeeze the others into a few bars
  for (const std::size_t k : comparison.worst) residuals.push_back(*comparison.pairs[k].residual);
  if (residuals.empty()) return {};
  const auto [smallest, largest] = std::minmax_element(residuals.begin(), residuals.end());
  const double bin_width = round_step(std::max(*largest - *smallest, 0.1) / 20);
  const auto first = static_cast<long>(std::floor(*smallest / bin_width));
  const auto last = std::max(first + 1, static_cast<long>(std::floor(*largest / bin_width)) + 1);
  HistogramChart chart;
  chart.description = words.say("comparison.residuals.description");
  for (long k = first; k < last; ++k) {
    const double from = static_cast<double>(k) * bin_width, to = static_cast<double>(k + 1) * bin_width;
    const auto count = std::count_if(residuals.begin(), residuals.end(),
                                     [&](double value) { return value >= from && value < to; });
    chart.bars.push_back({from, to, static_cast<double>(count), "bar",
                          words.say_count("comparison.residuals.bar", static_cast<std::uint64_t>(count),
                                          words.plain(from), words.plain(to))});
  }
  const double low = chart.bars.front().from, high = chart.bars.back().to;
  for (const double value : multiples(low, high, round_step((high - low) / 6)))
    chart.ticks.push_back({value, words.plain(value)});
  chart.lines.push_back({0, words.say("comparison.residuals.factor")});
  chart.x_title = words.say("comparison.residuals.x");
  chart.y_title = words.say("comparison.residuals.y");
  const std::size_t outliers = comparison.fitted - residuals.size();
  return html_figure(words.say("comparison.residuals.figure"), histogram_svg(words, chart),
                     outliers > 0 ? words.say_count("comparison.residuals.outliers", outliers) : "");
}

std::string pair_table(const Words& words, const ComparisonInput& input,
                       const std::vector<std::size_t>& pairs) {
  HtmlTable table({{words.say("column.label"), false},
                   {words.say("comparison.column.transceiver"), false},
                   {words.say("comparison.column.measured")},
                   {words.say("comparison.column.expected")},
                   {words.say("comparison.column.residual")},
                   {words.say("comparison.column.deviations")}});
  for (std::size_t k = 0; k < std::min(pairs.size(), max_compared); ++k) {
    const ComparedPair& pair = input.pairs[pairs[k]];
    const PairResult& result = input.comparison.pairs[pairs[k]];
    table.add_row({input.matrix.labels[pair.label].id,
                   pair.transceiver ? input.matrix.transceivers[*pair.transceiver].id
                                    : words.say("comparison.all_units"),
                   words.significant(pair.measured), words.significant(result.expected),
                   residual_text(words, result), words.significant(result.standardized, 2)});
  }
  std::string html = table.html();
  if (pairs.size() > max_compared)
    html += paragraph(words.say("comparison.first", max_compared, words.grouped(pairs.size())), "note");
  return html;
}

std::string transceiver_section(const Words& words, const ComparisonInput& input) {
  const auto& residuals = input.comparison.transceivers;
  if (residuals.size() < 2) return {};
  std::vector<TransceiverResidual> sorted = residuals;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return std::abs(a.median) > std::abs(b.median); });
  HtmlTable table({{words.say("comparison.column.transceiver"), false},
                   {words.say("comparison.column.pairs")},
                   {words.say("comparison.column.median")}});
  for (std::size_t k = 0; k < std::min(sorted.size(), max_compared); ++k)
    table.add_row({input.matrix.transceivers[sorted[k].transceiver].id, words.grouped(sorted[k].pairs),
                   words.decibels(sorted[k].median)});
  std::string html = table.html();
  if (sorted.size() > max_compared)
    html += paragraph(words.say("comparison.transceivers.first", max_compared, words.grouped(sorted.size())),
                      "note");
  return html_section("transceivers", words.say("comparison.transceivers.title"), html);
}

}  // namespace

std::string comparison_csv(const ComparisonInput& input) {
  const auto text = [&](std::string_view field) { return csv_field(field, input.safe_csv); };
  std::string csv =
      "label,transceiver,measured,error,simulated,standard_error,scaled,residual_db,standardized,use,"
      "outlier\n";
  for (std::size_t k = 0; k < input.pairs.size(); ++k) {
    const ComparedPair& pair = input.pairs[k];
    const PairResult& result = input.comparison.pairs[k];
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", text(input.matrix.labels[pair.label].id),
                       pair.transceiver ? text(input.matrix.transceivers[*pair.transceiver].id) : "",
                       csv_number(pair.measured), pair.error ? csv_number(*pair.error) : "",
                       csv_number(pair.simulated), csv_number(pair.standard_error),
                       csv_number(pair.measured / input.comparison.factor),
                       result.residual ? csv_number(*result.residual) : "", csv_number(result.standardized),
                       use_name(result.use), result.outlier ? 1 : 0);
  }
  return csv;
}

std::string comparison_html(const Words& words, const ComparisonInput& input) {
  const Comparison& comparison = input.comparison;
  const std::vector<std::string> statements = comparison_statements(words, comparison);
  const bool bad = (comparison.test && comparison.test->rejected()) || !comparison.outliers.empty();
  const std::string title = words.say("comparison.title", input.measured_name, input.simulated_name);
  std::string body = html_header({bad ? "open" : "yes",
                                  escape(words("comparison.kicker")),
                                  title,
                                  statements.front(),
                                  {statements.begin() + 1, statements.end()}});
  body += html_section("signals", words.say("comparison.signals.title"),
                       "<div class=\"pair\">\n" + scatter_figure(words, input) +
                           residual_figure(words, comparison) + "</div>\n");
  if (!comparison.outliers.empty())
    body += html_section(
        "outliers", words.say_count("comparison.outliers.title", comparison.outliers.size()),
        paragraph(words.say("comparison.outliers.note")) + pair_table(words, input, comparison.outliers));
  body += html_section("worst", std::string(worst_pairs_heading(words, comparison)),
                       pair_table(words, input, comparison.worst));
  body += transceiver_section(words, input);
  return html_page(words, title, "<main>\n" + body + "</main>\n");
}

}  // namespace shelfbeam
