#include "shelfbeam/report/mounting/mounting_sheet.hpp"

#include <numeric>

#include "shelfbeam/report/data/walking_order.hpp"
#include "shelfbeam/report/place/place_text.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

double length_of(const std::vector<Vec3>& positions, const std::vector<std::size_t>& order) {
  double sum = 0;
  for (std::size_t k = 1; k < order.size(); ++k) sum += length(positions[order[k]] - positions[order[k - 1]]);
  return sum;
}

TEST(WalkingOrder, IsNearlyTheShortestWay) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> metres(0, 20);
  double ratios = 0;
  constexpr int cases = 40;
  for (int k = 0; k < cases; ++k) {
    std::vector<Vec3> positions(7);
    for (Vec3& p : positions) p = {metres(random), metres(random), 0};
    const std::vector<std::size_t> order = walking_order(positions);
    std::vector<std::size_t> any(positions.size());
    std::iota(any.begin(), any.end(), 0U);
    ASSERT_TRUE(std::is_permutation(order.begin(), order.end(), any.begin()));
    double shortest = std::numeric_limits<double>::infinity();
    do {
      if (any.front() == order.front()) shortest = std::min(shortest, length_of(positions, any));
    } while (std::next_permutation(any.begin(), any.end()));
    EXPECT_GE(length_of(positions, order), shortest - 1e-9);
    ratios += length_of(positions, order) / shortest;
  }
  EXPECT_LT(ratios / cases, 1.03);
}

TEST(WalkingOrder, BeginsAtTheCornerAndBreaksTiesByOrder) {
  EXPECT_EQ(walking_order(std::vector<Vec3>{{9, 9, 0}, {1, 1, 0}, {1, 1, 0}, {5, 5, 0}}),
            (std::vector<std::size_t>{1, 2, 3, 0}));
  EXPECT_TRUE(walking_order({}).empty());
}

TEST(MountingSheet, ListsTheUnitsInWalkingOrderInWholeCentimetres) {
  Supermarket s;
  s.scene.transceivers[s.placement.selected[1]].roll_deg = 30;
  s.matrix.transceivers[s.placement.selected[1]].axis = {0, -0.5, -std::sqrt(0.75)};
  const ReportData data(s.input);
  const auto sheet = mounting_sheet(s.input);
  ASSERT_EQ(sheet.size(), s.placement.count());
  for (std::size_t k = 0; k < sheet.size(); ++k) {
    EXPECT_EQ(sheet[k].number, k + 1);
    EXPECT_EQ(data.unit_number(data.outcome.units[k].column), k + 1);
    EXPECT_EQ(sheet[k].id, data.transceiver(data.outcome.units[k].column).id);
  }
  const auto turned = std::find_if(sheet.begin(), sheet.end(), [](const auto& u) { return u.roll_deg > 0; });
  ASSERT_NE(turned, sheet.end());
  EXPECT_EQ(direction_of(english(), *turned), "30° towards the bottom, turned 30°");
  EXPECT_EQ(centimetres(2.91428571), 291);
  const auto rows = read_csv(mounting_csv(s.input));
  ASSERT_EQ(rows.size(), sheet.size() + 1);
  for (std::size_t k = 0; k < sheet.size(); ++k) {
    EXPECT_EQ(rows[k + 1][0], std::to_string(k + 1));
    EXPECT_EQ(rows[k + 1][1], sheet[k].id);
    EXPECT_EQ(rows[k + 1][4], std::to_string(centimetres(sheet[k].references[0].distance)));
    EXPECT_EQ(rows[k + 1][8], std::to_string(height_cm(sheet[k])));
    EXPECT_EQ(rows[k + 1][13], place_text(english(), sheet[k].place));
  }
}

// In the page, the distances of a unit stand in the row of its number.
TEST(MountingSheet, IsTheSecondSectionOfThePage) {
  const Supermarket s;
  const Page page(s.input);
  EXPECT_EQ(page.html.find("<section"), page.html.find("<section id=\"mounting\""))
      << "the first page has no section element";
  const std::string text =
      read_markup(page.section("<section id=\"mounting\"", "</section>") + "</section>").text;
  std::size_t at = 0;
  for (const MountedUnit& unit : mounting_sheet(s.input))
    for (const std::string& piece :
         {fmt::format("\n{}\n", unit.number), fmt::format("{} cm ", centimetres(unit.references[0].distance)),
          fmt::format("{} cm ", centimetres(unit.references[1].distance)), unit.id}) {
      at = text.find(piece, at);
      ASSERT_NE(at, std::string::npos) << unit.number << " " << piece;
    }
}

TEST(MountingSheet, ShowsOrderNumberFixingAndPictureOfTheTypes) {
  Kiosk s;
  const Page plain(s.input);
  for (const char* part : {"class=\"kind\"", "Order number"}) EXPECT_FALSE(plain.has(part)) << part;
  TransceiverType& type = s.scene.transceiver_types.at(0);
  type.order_number = "4711 <B>";
  type.fixing = "magnet & clip";
  type.picture = "data:image/png;base64,iVBORw0KGgo=";
  const Page page(s.input);
  EXPECT_THAT(missing_in(page.section("<div class=\"kind\">", "</div></div>"),
                         {"src=\"data:image/png;base64,iVBORw0KGgo=\"", "Order number 4711 &lt;B&gt;",
                          "Fixing: magnet &amp; clip", "<b>ceiling</b>"}),
              testing::IsEmpty());
  EXPECT_THAT(page.section("<h2>Transceivers", "</table>"), testing::HasSubstr("<td>4711 &lt;B&gt;</td>"));
  EXPECT_EQ(read_csv(mounting_csv(s.input))[1][15], "4711 <B>");
  EXPECT_EQ(read_csv(placement_csv(s.input))[1][16], "4711 <B>");
  EXPECT_THAT(mounting_dxf(s.input), testing::HasSubstr("\n4711 <B>\n"));
}

TEST(MountingSheet, NamesTheUnitsThatNeedALift) {
  Supermarket s;
  EXPECT_FALSE(Page(s.input).has_text("lift")) << "all are at 3.9 m";
  for (const std::uint32_t column : s.placement.selected) s.matrix.transceivers[column].position.z = 4.1;
  const Page high(s.input);
  EXPECT_EQ(count_of("410 cm, lift\n", high.text), s.placement.count());
  EXPECT_TRUE(high.has_text(fmt::format("{} units are to be mounted more than 4 m", s.placement.count())));
  s.matrix.transceivers[s.placement.selected[0]].installed = true;
  EXPECT_EQ(count_of("410 cm, lift\n", Page(s.input).text), s.placement.count() - 1);
}

TEST(MountingSheet, SaysHowFarAUnitMayBeOff) {
  Supermarket s;
  for (LabelRow& label : s.matrix.labels) label.requirement *= 0.4;
  const std::vector<MountedUnit> sheet = mounting_sheet(s.input);
  const auto rows = read_csv(mounting_csv(s.input));
  std::size_t known = 0;
  for (std::size_t k = 0; k < sheet.size(); ++k) {
    const long cm = centimetres(sheet[k].tolerance);
    EXPECT_EQ(rows[k + 1][14], cm > 0 ? std::to_string(cm) : "");
    known += cm > 0 ? 1 : 0;
  }
  ASSERT_GT(known, 0U);
  const Page page(s.input);
  EXPECT_EQ(count_of("<td data-label=\"Fine within\" class=\"n\"><div>–<", page.html), sheet.size() - known);
  EXPECT_EQ(count_of("<td data-label=\"Fine within\"", page.html), sheet.size());
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  for (std::size_t i = 0; i < s.matrix.rows(); ++i)
    s.matrix.labels[i].requirement = outcome.labels[i].signal;  // no reserve
  EXPECT_FALSE(Page(s.input).has("Fine within"));
}

TEST(MountingSheet, IsEmptyWithoutASelection) {
  Kiosk s;
  s.placement = {};
  s.placement.status = Status::infeasible;
  EXPECT_TRUE(mounting_sheet(s.input).empty());
  EXPECT_FALSE(Page(s.input).has("id=\"mounting\""));
  EXPECT_EQ(read_csv(mounting_csv(s.input)).size(), 1U);
}

}  // namespace
}  // namespace shelfbeam::test
