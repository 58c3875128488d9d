// Tests the sections of a plan that are written only on request.

#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/report/chart/charts.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::fault;
using test::pieces;
using test::read_markup;
using test::static_report;
using test::Supermarket;

Sensitivity made_up() {
  Sensitivity made;
  made.as_given = {1.25, 0.0125, 3};
  made.low = {{0.5, 0.005, 7}, {7, 8, 9}, {21}};
  made.high = {{1.75, 0.01, 4}, {}, {}};
  for (const char* name : {"tiles <grey>", "carton"}) {
    MaterialSensitivity one{name, 0.6, 0.45, 0.75, made.materials.empty(), {}, {}};
    one.at_lower = {{0.8, 0.008, 5}, -0.375, 0.00131, -0.0621, 2};
    one.at_upper = {{1.6, 0.008, 6}, 0.25, 0.00131, 0.0878, 0};
    made.materials.push_back(one);
  }
  made.kept = {"glass"};
  made.watched = 256;
  return made;
}

TEST(PlanSections, AreOptional) {
  const Supermarket s;
  const std::string html = static_report(s.input);
  for (const char* id : {"id=\"sensitivity\"", "id=\"curve\""}) EXPECT_EQ(html.find(id), std::string::npos);
}

TEST(PlanSections, ShowTheEffectOfReflectances) {
  Supermarket s;
  s.plan.sensitivity = made_up();
  const std::string html = static_report(s.input);
  EXPECT_EQ(fault(html), "");
  const std::string text = read_markup(html).text;
  const auto cells = pieces(html);
  for (const char* piece : {"922 of 926 labels are reached with", "10\u00A0% to both sides is assumed",
                            "their reflectance: glass", "256 labels with the smallest margins",
                            "3 labels missed at the low end", "1 label undecided at the low end"})
    EXPECT_NE(text.find(piece), std::string::npos) << piece;
  for (const std::string& cell :
       {std::string("0.6 (0.45 to 0.75) *"), std::string("0.6 (0.45 to 0.75)"), std::string("−0.97\u00A0dB"),
        std::string("−37.5\u00A0% (±\u00A00.13)"), std::string("−6.2\u00A0%"), std::string("+8.8\u00A0%"),
        ReportData(s.input).names.name(5)})
    EXPECT_TRUE(cells.contains(cell)) << cell;
  EXPECT_FALSE(cells.contains("−6.4\u00A0%")) << "nothing that is not in it";
  EXPECT_EQ(test::count_of("class=\"bar short\"><title>all together: ", html), 1U);
}

TEST(PlanSections, StateThatAPlanHolds) {
  Supermarket s;
  s.plan.sensitivity = made_up();
  s.plan.sensitivity->low = {{1.0625, 0.01, 2}, {}, {}};
  for (MaterialSensitivity& one : s.plan.sensitivity->materials) one.at_upper.mean_change = 1e-5;
  const std::string html = static_report(s.input);
  EXPECT_EQ(fault(html), "");
  EXPECT_EQ(html.find("missed at the low end"), std::string::npos);
  EXPECT_TRUE(pieces(html).contains("0.0\u00A0%"));
  EXPECT_FALSE(pieces(html).contains("+0.0\u00A0%"));
}

// A label without light has no margin in decibels, but its bar must end.
TEST(PlanSections, DrawMarginsOfNothing) {
  Supermarket s;
  s.plan.sensitivity = made_up();
  s.plan.sensitivity->low.min_margin.ratio = 0;
  const std::string html = static_report(s.input);
  EXPECT_EQ(fault(html), "");
  for (const char* broken : {"nan\"", "inf\""}) EXPECT_EQ(html.find(broken), std::string::npos);
  EXPECT_EQ(tornado_svg(english(), {}), "");
}

TEST(PlanSections, ShowTheCoverageOfFewerUnits) {
  Supermarket s;
  for (std::size_t k = 1; k <= 45; ++k) s.plan.curve.points.push_back({k, 20 * k, 20 * k + 26});
  std::string html = static_report(s.input);
  EXPECT_EQ(fault(html), "");
  const auto cells = pieces(html);
  EXPECT_TRUE(cells.contains("97.1\u00A0%"));
  EXPECT_TRUE(cells.contains("100.0\u00A0%"));
  EXPECT_NE(html.find("45 transceivers: at least 97.1"), std::string::npos);
  EXPECT_EQ(html.find("stopped early; more time"), std::string::npos);
  s.plan.curve.points.resize(1);
  s.plan.curve.is_complete = false;
  html = static_report(s.input);
  EXPECT_EQ(fault(html), "");
  EXPECT_NE(html.find("stopped early; more time"), std::string::npos);
  EXPECT_EQ(html.find("Labels reached by fewer transceivers"), std::string::npos) << "one point is no curve";
}

}  // namespace
}  // namespace shelfbeam
