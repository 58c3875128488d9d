#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/placement/answer/names.hpp"
#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/report/data/distributions.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/data/text_format.hpp"
#include "shelfbeam/report/messages/end_reason.hpp"
#include "shelfbeam/report/messages/proof.hpp"
#include "shelfbeam/report/messages/reach.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/markup.hpp"
#include "unit/report/sample_store.hpp"
#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::certify;
using test::fault;
using test::pieces;
using test::read_markup;
using test::Supermarket;
using test::without_scripts;

TEST(Markup, ReaderRejectsBrokenMarkup) {
  EXPECT_EQ(read_markup("<p class=\"a\">x &amp; y<br></p>").problem, "");
  for (const char* broken : {"<p>", "<p></b>", "a & b", "<p class=a></p>", "<p class=\"<\"></p>", "a < b",
                             "a > b", "<p a=\"1\" a=\"2\"></p>", "<use href=\"#x\"></g>"})
    EXPECT_NE(read_markup(broken).problem, "") << broken;
  EXPECT_NE(fault("<svg><use href=\"#missing\"/></svg>"), "");
  EXPECT_NE(fault("<img src=\"http://example.com/x.png\">"), "");
  EXPECT_NE(fault("<script src=\"x.js\"></script>"), "");
  EXPECT_EQ(fault("<script>a < b && c</script>"), "");
  EXPECT_EQ(without_scripts("<p>a</p><script id=\"x\">b</script>c"), "<p>a</p><script id=\"x\"></script>c");
}

TEST(ReportHtml, IsOneSelfContainedPage) {
  const Supermarket s;
  const std::string html = test::static_report(s.input);
  EXPECT_EQ(fault(html), "");
  EXPECT_EQ(html, test::static_report(s.input));
  EXPECT_EQ(report_html(s.input), report_html(s.input));
}

TEST(ReportHtml, EscapesIdsAndNames) {
  const Scene scene = make_scene(sample_store::kiosk());
  const SignalMatrix matrix = sample_store::matrix_of(scene);
  Placement placement = sample_store::cover(matrix);
  placement.solver = {Method::mip, "<solver>"};
  const std::string html = test::static_report({scene, matrix, {placement}});
  EXPECT_EQ(fault(html), "");
  const std::string text = read_markup(html).text;
  for (const char* name : {"Joe's <Kiosk> & \"Bar\"", "A<1>-front-1-1", "T,2", "<solver>"})
    EXPECT_NE(text.find(name), std::string::npos) << name;
  for (const char* raw : {"<Kiosk>", "A<1>", "<solver>"}) EXPECT_EQ(html.find(raw), std::string::npos) << raw;
}

TEST(ReportHtml, ContainsEveryComputedNumber) {
  const Supermarket s;
  const ReportData data(s.input);
  const std::string html = test::static_report(s.input);
  const auto cells = pieces(html);
  const std::string text = read_markup(html).text;
  const auto expect_text = [&](const std::string& piece) {
    EXPECT_NE(text.find(piece), std::string::npos) << piece;
  };
  const auto expect_cell = [&](const std::string& piece) { EXPECT_TRUE(cells.contains(piece)) << piece; };

  for (const UnitOutcome& unit : data.outcome.units) {
    expect_cell(data.transceiver(unit.column).id);
    expect_cell(grouped(unit.reaches_alone));
    expect_cell(grouped(unit.strongest_for));
    expect_cell(grouped(unit.needed_by));
  }
  for (std::size_t k = 0; k < 20; ++k) {
    const std::uint32_t row = data.outcome.by_margin[k];
    expect_cell(data.label(row).id);
    expect_cell(english().decibels(data.outcome.labels[row].margin()));
    expect_cell(data.unit.number(data.outcome.labels[row].signal));
    expect_cell(data.unit.number(
        static_cast<double>(s.matrix.standard_error[s.matrix.at(row, *data.outcome.labels[row].strongest)])));
  }
  for (std::size_t k = 0; k < data.levels.size(); ++k)
    expect_cell("Level " + std::to_string(k + 1) + ": " + data.levels[k].heights(english()) + " (" +
                grouped(data.levels[k].labels.size()) + ")");
  expect_text("all " + grouped(data.outcome.met) + " labels receive enough signal");
  expect_text(grouped(data.outcome.redundant) + " of " + grouped(data.outcome.labels.size()) + " (");
  const SamplingSummary& sampling = data.sampling;
  for (const double share : {sampling.mean, sampling.median, sampling.p90, sampling.p99, sampling.worst})
    expect_text(english().percent(share));
  expect_cell(grouped(sampling.min_samples));
  expect_cell(grouped(sampling.relevant));
  expect_text(grouped(sampling.zeros) + " of " + grouped(sampling.entries));
  const auto shares = data.outcome.direct_shares();
  for (const double q : {0.1, 0.5, 0.9}) expect_text(english().percent(quantile(shares, q)));
  expect_text(grouped(data.outcome.met_by_direct_light) + " of " + grouped(data.outcome.labels.size()));
  const ExcessDistribution excess = excess_distribution(data.outcome);
  expect_text("Median " + english().significant(excess.median) + "\u00A0%, mean " +
              english().significant(excess.mean));
  for (const std::string& fact : {s.placement.solver.backend.value(), s.matrix.provenance.estimator,
                                  s.matrix.provenance.store_hash, std::string("940\u00A0nm")})
    expect_cell(fact);
  // Negative control: a number that was not computed is not found.
  EXPECT_FALSE(cells.contains(grouped(data.outcome.met + 1)));
}

TEST(ReportHtml, HasTheNumbersOfTheCertificate) {
  Supermarket s;
  certify(s);
  const Certificate& certificate = *s.plan.certificate;
  const std::string html = test::static_report(s.input);
  EXPECT_EQ(fault(html), "");
  const auto cells = pieces(html);
  const std::string reached = grouped(certificate.count(Verdict::reached));
  for (const std::string& cell : {std::string("95\u00A0%"), reached + " of 926", std::string("37 labels"),
                                  end_text(english(), *certificate.open)})
    EXPECT_TRUE(cells.contains(cell)) << cell;
  const std::string text = read_markup(html).text;
  for (const std::string& piece :
       {std::string("Rounds\n\n3\n"),
        fmt::format("Lower bound on the count\n\n{}\n", certificate.count_lower_bound),
        "confidence that " + reached + " of 926 labels receive enough signal.",
        std::string("Missed\n\n19: 2 on A1, "), std::string("Undecided\n\n19: 2 on A1, ")})
    EXPECT_NE(text.find(piece), std::string::npos) << piece;
  // The labels with the smallest margins have their verdicts in the table.
  const ReportData data(s.input);
  const std::string table = html.substr(html.find("id=\"weakest\""));
  for (std::size_t k = 0, at = 0; k < 20; ++k) {
    const std::uint32_t row = data.outcome.by_margin[k];
    at = table.find("<tr><td>" + escape(data.names.name(row)) + "</td>", at);
    ASSERT_NE(at, std::string::npos) << data.names.name(row);
    const std::string line = table.substr(at, table.find("</tr>", at) - at);
    const auto verdict = std::string(to_text(certificate.labels[row].verdict));
    EXPECT_NE(line.find(">" + verdict + "<"), std::string::npos) << line;
  }
}

// The page contains sections for this kind of problem and result, and no others.
TEST(ReportHtml, NamesTheSeedsOfPlanAndSignals) {
  Supermarket s;
  s.matrix.provenance.seed = 8'231;
  const auto names = [&](const char* text) {
    return test::pieces(test::static_report(s.input)).contains(text);
  };
  EXPECT_TRUE(names("8231"));
  s.plan.seed = 8'231;
  EXPECT_TRUE(names("8231"));
  s.plan.seed = 8'232;
  EXPECT_FALSE(names("8231"));
  EXPECT_TRUE(names("8232; 8231 of the signals"));
}

TEST(ReportHtml, MarksPlansWithoutACertificate) {
  Supermarket s;
  const std::string mark(english()("certificate.lacking"));
  const auto marks = [&] {
    const std::string text = read_markup(test::static_report(s.input)).text, drawing = mounting_dxf(s.input);
    std::size_t count = drawing.find(mark) == std::string::npos ? 0 : 1;
    for (std::size_t at = 0; (at = text.find(mark, at)) != std::string::npos; ++at) ++count;
    return count;
  };
  EXPECT_EQ(marks(), 4U) << "summary, mounting sheet, details and drawing";
  certify(s);
  EXPECT_EQ(marks(), 0U);
}

TEST(ReportHtml, HasTheSectionsOfTheResult) {
  struct Case {
    std::function<void(Placement&)> change;
    std::vector<std::string> pieces;
  };
  const auto infeasible = [](Placement& p, const PlacementProblem& problem,
                             std::vector<Unreachable> unreachable) {
    p = {};
    p.problem = problem;
    p.status = Status::infeasible;
    p.unreachable = std::move(unreachable);
  };
  const auto usual = pieces(report_html(Supermarket().input));
  for (const auto& [change, wanted] : std::vector<Case>{
           {[](Placement& p) { p.problem.objective = Objective::links; }, {"Gap of the objective"}},
           {[](Placement& p) { p.status = Status::stopped; }, {"stopped early"}},
           {[](Placement& p) { p.min_spacing = 2.5, p.forbidden_pairs = 1200; },
            {"Minimum distance between units", "2.5\u00A0m", "Excluded pairs of candidates", "1,200"}},
           {[](Placement& p) { p.bound_proof = BoundProof::log, p.ties_settled = true; },
            {std::string(bound_proof_text(english(), BoundProof::log)),
             "this one has the largest minimum margin"}},
           {[](Placement& p) { p.problem.redundant = true; },
            {"signals without each label's strongest unit"}},
           {[&](Placement& p) { infeasible(p, {}, {}); }, {"No selection reaches all labels."}},
           {[&](Placement& p) {
              infeasible(p, {.model = CommunicationModel::non_cooperative, .redundant = true}, {{3, 1, 0}});
            },
            {std::string(no_signal_reason(english(), {.redundant = true}, true)),
             "The maximum signal is the signal that the label would receive from the best single candidate "
             "that remains if the strongest fails."}}}) {
    Supermarket s;
    change(s.placement);
    const std::string html = report_html(s.input);
    EXPECT_EQ(fault(html), "");
    const auto cells = pieces(html);
    for (const std::string& piece : wanted) {
      EXPECT_TRUE(cells.contains(piece)) << piece;
      EXPECT_FALSE(usual.contains(piece)) << piece;
    }
  }
}

TEST(ReportHtml, StatesAValidCertificate) {
  Supermarket s;
  certify(s);
  for (LabelVerdict& label : s.plan.certificate->labels) label.verdict = Verdict::reached;
  s.plan.certificate->open.reset();
  const std::string text = read_markup(test::static_report(s.input)).text;
  for (const char* piece : {"Verified", "Missed\n\nnone\n"}) EXPECT_NE(text.find(piece), std::string::npos);
  s.plan.certificate->labels[5].verdict = Verdict::missed;
  const std::string missed = read_markup(test::static_report(s.input)).text;
  EXPECT_EQ(missed.find("Verified"), std::string::npos);
  EXPECT_NE(missed.find("Missed\n\n1: " + ReportData(s.input).names.name(5) + "\n"), std::string::npos);
}

TEST(ReportHtml, EveryLabelIsMarkedOnceOnThePlans) {
  const Supermarket s;
  const ReportData data(s.input);
  const std::string text = report_html(s.input);
  for (std::uint32_t i = 0; i < data.outcome.labels.size(); i += 37) {
    const std::string title = "<title>" + data.names.name(i) + ": " +
                              data.unit.text(data.outcome.labels[i].signal) + ", " +
                              english().decibels(data.outcome.labels[i].margin()) + "</title>";
    const std::size_t first = text.find(title);
    ASSERT_NE(first, std::string::npos) << title;
    EXPECT_EQ(text.find(title, first + 1), std::string::npos) << title;
  }
}

TEST(ReportHtml, MarksLabelsThatDependOnFlaggedSignals) {
  Supermarket s;
  const auto hollow = [&] {
    const std::string html = test::static_report(s.input);
    EXPECT_EQ(fault(html), "");
    std::size_t count = 0;
    for (const auto& element : read_markup(html).elements)
      if (const auto href = element.attributes.find("href"); href != element.attributes.end())
        count += href->second == "#hollow" && element.attributes.contains("x") ? 1 : 0;
    return count;
  };
  const auto facts = [&] { return pieces(test::static_report(s.input)); };
  // Unknown facts are not mentioned, and without flags nothing is marked.
  EXPECT_EQ(hollow(), 0U);
  EXPECT_FALSE(facts().contains("Entries with an unreliable error"));
  s.matrix.flags.assign(s.matrix.mean.size(), 0);
  EXPECT_EQ(hollow(), 0U);
  EXPECT_TRUE(facts().contains("0 (0.0\u00A0%)"));
  for (const char* text : {"hollow mark", "(not reliable)", "error not reliable: "})
    EXPECT_EQ(test::static_report(s.input).find(text), std::string::npos) << text;

  const std::uint32_t least = ReportData(s.input).outcome.by_margin.front();
  for (std::size_t j = 0; j < s.matrix.columns(); ++j) s.matrix.flags[s.matrix.at(least, j)] = 1;
  EXPECT_EQ(hollow(), 1U);
  const ReportData data(s.input);
  EXPECT_GT(data.sampling.flagged, 0U);
  EXPECT_LT(data.sampling.flagged, s.matrix.columns());
  EXPECT_TRUE(facts().contains(fmt::format("{} ({})", data.sampling.flagged,
                                           english().percent(static_cast<double>(data.sampling.flagged) /
                                                             static_cast<double>(data.sampling.relevant)))));
  EXPECT_TRUE(facts().contains("error not reliable: 1"));
  const std::string html = test::static_report(s.input);
  EXPECT_NE(html.find("The label with a hollow mark depends on"), std::string::npos);
  EXPECT_NE(html.find(" (not reliable)</td>"), std::string::npos);
}

TEST(ReportHtml, ListsTheLabelsThatEachUnitServes) {
  const Supermarket s;
  const ReportData data(s.input);
  const std::string html = test::static_report(s.input);
  const std::string list =
      html.substr(html.find("<details>"), html.find("</details>") - html.find("<details>"));
  std::size_t counts = 0, at = 0;
  for (std::size_t k = 0; k < data.outcome.units.size(); ++k) {
    at = list.find("<dt>" + std::to_string(k + 1) + ": ", at);
    ASSERT_NE(at, std::string::npos) << k;
    for (const std::string& count : data.names.counts(data.outcome.served_by(k))) {
      ++counts;
      at = list.find("<li>" + escape(count) + "</li>", at);
      ASSERT_NE(at, std::string::npos) << k << " " << count;
    }
  }
  EXPECT_GT(counts, data.outcome.units.size());
  EXPECT_EQ(test::count_of("<li>", list), counts);
}

TEST(ReportHtml, ShowsTheAimOfChosenUnits) {
  Supermarket s;
  EXPECT_TRUE(pieces(test::static_report(s.input)).contains("down"));
  TransceiverColumn& unit = s.matrix.transceivers[s.placement.selected.front()];
  const auto looks = [&](const Vec3& axis, const std::string& text) {
    unit.axis = axis;
    EXPECT_EQ(pieces(test::static_report(s.input)).count(text), 1U) << text;
  };
  looks({std::sqrt(0.75), 0, -0.5}, "60.0° towards 0.0°");
  looks({0, -std::sqrt(0.5), -std::sqrt(0.5)}, "45.0° towards 270.0°");
  looks({0, 0, 1}, "up");
  // Without the one in the legend.
  const auto noses = [&] { return test::count_of("\"k aim\"", test::static_report(s.input)) - 1; };
  EXPECT_EQ(noses(), 0U);
  EXPECT_FALSE(pieces(test::static_report(s.input)).contains("tilted this way"));
  unit.axis = {0.6, 0, -0.8};
  EXPECT_EQ(noses(), 1U);
  EXPECT_TRUE(pieces(test::static_report(s.input)).contains("tilted this way"));
  s.scene.transceivers[s.placement.selected.front()].roll_deg = 30;
  looks({0, 1, 0}, "90.0° towards 90.0°, roll 30°");
}

TEST(ReportHtml, NamesLabelsWithoutDirectLight) {
  Supermarket s;
  EXPECT_EQ(report_html(s.input).find("no direct light"), std::string::npos);
  std::fill(s.matrix.direct.begin(), s.matrix.direct.end(), 0.0F);
  EXPECT_NE(report_html(s.input).find("one label in ten receives no direct light"), std::string::npos);
}

TEST(ReportHtml, ExplainsInfeasibility) {
  Supermarket s;
  for (LabelRow& label : s.matrix.labels) label.requirement *= 60;
  s.placement = {};
  s.placement.status = Status::infeasible;
  s.placement.count_lower_bound = s.placement.lower_bound = s.placement.objective_value = INFINITY;
  for (std::uint32_t i = 0; i < s.matrix.rows(); ++i) {
    double most = 0;
    for (const float signal : s.matrix.mean_row(i)) most += static_cast<double>(signal);
    if (most < s.matrix.labels[i].requirement)
      s.placement.unreachable.push_back({i, s.matrix.labels[i].requirement, most});
  }
  ASSERT_GT(s.placement.unreachable.size(), 3U);
  const std::string html = test::static_report(s.input);
  EXPECT_EQ(fault(html), "");
  const auto cells = pieces(html);
  const ReportData data(s.input);
  for (const Unreachable& label : s.placement.unreachable) {
    EXPECT_TRUE(cells.contains(data.names.name(label.label)));
    EXPECT_TRUE(cells.contains(data.unit.number(label.max_signal)));
  }
  // Triangles on the plans: one per missed label, and no others.
  std::size_t triangles = 0;
  for (const auto& element : read_markup(html).elements)
    if (const auto href = element.attributes.find("href");
        href != element.attributes.end() && element.attributes.contains("x"))
      triangles += href->second == "#m0" || href->second == "#m1" ? 1 : 0;
  EXPECT_EQ(triangles, 2 * s.placement.unreachable.size());
  for (const char* odd : {"∞", ">inf<", ">nan"}) EXPECT_EQ(html.find(odd), std::string::npos) << odd;
}

TEST(ReportHtml, ReadsWellWithoutSelectionErrorsOrDirectPart) {
  Supermarket s;
  s.matrix.standard_error.clear();
  s.matrix.direct.clear();
  EXPECT_EQ(fault(report_html(s.input)), "");
  EXPECT_NE(report_html(s.input).find("contains no standard errors"), std::string::npos);
  s.placement = {};
  s.placement.count_lower_bound = 3;
  s.placement.seconds = 60;
  const std::string html = test::static_report(s.input);
  EXPECT_EQ(fault(html), "");
  for (const char* odd : {">nan", " nan", "∞"}) EXPECT_EQ(html.find(odd), std::string::npos) << odd;
}

TEST(ReportHtml, StaysSmallForFiveThousandLabels) {
  Store store = sample_store::empty_store("Large", {60, 40, 4});
  for (int k = 0; k < 25; ++k)
    store.fixtures.push_back({sample_store::gondola("A" + std::to_string(k), {5, 1.0 + 1.5 * k}, 50, 0.9,
                                                    {0.3, 0.7, 1.1, 1.5, 1.9}, 0, {Face::front}),
                              "fixtures"});
  for (auto& fixture : store.fixtures) std::get<Gondola>(fixture.value).labels->spacing = 1.25;
  store.grids = {{{{5, 5}, {55, 35}, 10, 3.9, {0, 0, -1}, 0, {}}, "store.json: transceivers.grids[0]"}};
  const Scene scene = make_scene(store);
  ASSERT_EQ(scene.labels.size(), 5000U);
  const SignalMatrix matrix = sample_store::matrix_of(scene);
  Placement placement;
  placement.status = Status::feasible;
  placement.selected = {0, 5, 9, 14, 20};
  const std::string html = test::static_report({scene, matrix, {placement}});
  EXPECT_LT(html.size(), 1'000'000U);
  EXPECT_EQ(fault(html), "");
}

}  // namespace
}  // namespace shelfbeam
