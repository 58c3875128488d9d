#include "shelfbeam/report/mounting/mounting_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/outcome.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/walking_order.hpp"
#include "shelfbeam/report/place/place_text.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "unit/report/csv_reader.hpp"
#include "unit/report/supermarket_report.hpp"

namespace shelfbeam {
namespace {

using test::Supermarket;

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

// A room of 20 x 30 m with a tall box, a low one and an upright mesh.
Scene hall() {
  Store store = sample_store::empty_store("Hall", {20, 30, 4});
  store.fixtures.push_back({Box{"column", {9, 14, 0}, {10, 15, 4}, {}}, "fixtures"});
  store.fixtures.push_back({Box{"table", {9, 20, 0}, {11, 24, 1}, {}}, "fixtures"});
  MeshFixture wall{"wall", {}, 0, 1, {{"m", {}, {}, {}}}};
  wall.pieces[0].vertices = {{4, 2, 0}, {6, 4, 0}, {6, 4, 4}, {4, 2, 4}};
  wall.pieces[0].triangles = {{0, 1, 2}, {0, 2, 3}};
  store.fixtures.push_back({wall, "fixtures"});
  sample_store::add_devices(store, {15, 5, 1}, {15, 8, 3.9});
  return make_scene(store);
}

void expect_reference(const Reference& found, Side side, Reference::Kind kind, const std::string& fixture,
                      double distance) {
  EXPECT_EQ(found.side, side);
  EXPECT_EQ(found.kind, kind);
  EXPECT_EQ(found.fixture, fixture);
  EXPECT_NEAR(found.distance, distance, 1e-9);
}

TEST(Reference, IsTheNearestSurfaceAtTheHeightOfTheUnit) {
  const Scene scene = hall();
  using Kind = Reference::Kind;
  expect_reference(references_of(scene, {2, 27, 3.9})[0], Side::left, Kind::wall, "", 2);
  expect_reference(references_of(scene, {2, 27, 3.9})[1], Side::top, Kind::wall, "", 3);
  expect_reference(references_of(scene, {12, 14.5, 3})[0], Side::left, Kind::fixture, "column", 2);
  // The slanted wall, 3 m to the left, gives way to the square wall on the other side.
  expect_reference(references_of(scene, {8, 3, 3})[0], Side::right, Kind::wall, "", 12);
  // A wall that is far away precedes a fixture below.
  expect_reference(references_of(scene, {10.5, 19, 3.9})[1], Side::top, Kind::wall, "", 11);
  EXPECT_EQ(name_of(english(), references_of(scene, {2, 27, 3.9})[0]), "wall at the left");
}

// Without a room, there is nothing at the height of the unit.
TEST(Reference, IsAFixtureBelowWithoutAnythingAtTheHeightOfTheUnit) {
  Scene scene = hall();
  scene.room.reset();
  using Kind = Reference::Kind;
  expect_reference(references_of(scene, {10.5, 19, 3.9})[1], Side::top, Kind::fixture, "table", 1);
  expect_reference(references_of(scene, {10.5, 21, 3.9})[1], Side::bottom, Kind::end, "table", 1);
  EXPECT_EQ(name_of(english(), references_of(scene, {10.5, 21, 3.9})[1]), "bottom side of table");
}

// The distance along a wall that the laser grazes says nothing.
TEST(Reference, IsNoSurfaceAlongTheLaser) {
  Store store = sample_store::empty_store("Wedge", {20, 30, 4});
  store.room->shape.is_box = false;
  store.room->shape.outline = {{0, 0}, {20, 0}, {20, 30}, {8, 30}};  // a wall at the left with 15 degrees
  store.room->walls.assign(4, MaterialId{0});
  sample_store::add_devices(store, {15, 5, 1}, {15, 8, 3.9});
  const Scene scene = make_scene(store);
  // 1 m below the slanted wall and 24 m above that at the bottom.
  expect_reference(references_of(scene, {7, 24, 3})[1], Side::bottom, Reference::Kind::wall, "", 24);
  expect_reference(references_of(scene, {7, 24, 3})[0], Side::right, Reference::Kind::wall, "", 13);
}

TEST(Reference, IsTheAxisWithoutAnythingElse) {
  Scene scene = hall();
  scene.room.reset();
  scene.fixtures.clear();
  scene.parts.clear();
  const auto found = references_of(scene, {2, 27, 3.9});
  expect_reference(found[0], Side::left, Reference::Kind::origin, "", 2);
  expect_reference(found[1], Side::bottom, Reference::Kind::origin, "", 27);
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
  const auto rows = test::read_csv(mounting_csv(s.input));
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
  const std::string html = test::static_report(s.input);
  const std::size_t sheet = html.find("<section id=\"mounting\"");
  ASSERT_NE(sheet, std::string::npos);
  EXPECT_EQ(html.find("<section"), sheet) << "the first page has no section element";
  const auto units = mounting_sheet(s.input);
  const std::string text =
      test::read_markup(html.substr(sheet, html.find("</section>", sheet) - sheet) + "</section>").text;
  std::size_t at = 0;
  for (const MountedUnit& unit : units)
    for (const std::string& piece :
         {"\n" + std::to_string(unit.number) + "\n",
          std::to_string(centimetres(unit.references[0].distance)) + " cm ",
          std::to_string(centimetres(unit.references[1].distance)) + " cm ", unit.id}) {
      at = text.find(piece, at);
      ASSERT_NE(at, std::string::npos) << unit.number << " " << piece;
    }
}

// The texts of the page between two elements.
std::string part_of(const std::string& html, const std::string& begin, const std::string& end) {
  const std::size_t at = html.find(begin);
  return at == std::string::npos ? std::string() : html.substr(at, html.find(end, at) - at);
}

TEST(MountingSheet, ShowsOrderNumberFixingAndPictureOfTheTypes) {
  Supermarket s;
  const std::string plain = test::static_report(s.input);
  EXPECT_EQ(plain.find("class=\"kind\""), std::string::npos);
  EXPECT_EQ(plain.find("Order number"), std::string::npos);
  TransceiverType& type = s.scene.transceiver_types.at(0);
  type.order_number = "4711 <B>";
  type.fixing = "magnet & clip";
  type.picture = "data:image/png;base64,iVBORw0KGgo=";
  const std::string html = test::static_report(s.input);
  EXPECT_EQ(test::fault(html), "");
  const std::string kind = part_of(html, "<div class=\"kind\">", "</div></div>");
  for (const char* piece : {"src=\"data:image/png;base64,iVBORw0KGgo=\"", "Order number 4711 &lt;B&gt;",
                            "Fixing: magnet &amp; clip", "<b>ceiling</b>"})
    EXPECT_NE(kind.find(piece), std::string::npos) << piece;
  const std::string to_buy = part_of(html, "<h2>Transceivers", "</table>");
  EXPECT_NE(to_buy.find("<td>4711 &lt;B&gt;</td>"), std::string::npos) << to_buy;
  EXPECT_EQ(test::read_csv(mounting_csv(s.input))[1][15], "4711 <B>");
  EXPECT_EQ(test::read_csv(placement_csv(s.input))[1][16], "4711 <B>");
  EXPECT_NE(mounting_dxf(s.input).find("\n4711 <B>\n"), std::string::npos);
}

TEST(MountingSheet, NamesTheUnitsThatNeedALift) {
  Supermarket s;
  const auto text = [&] { return test::read_markup(test::static_report(s.input)).text; };
  EXPECT_EQ(text().find("lift"), std::string::npos) << "all are at 3.9 m";
  for (const std::uint32_t column : s.placement.selected) s.matrix.transceivers[column].position.z = 4.1;
  const std::string high = text();
  EXPECT_EQ(test::count_of("410 cm, lift\n", high), s.placement.count());
  EXPECT_NE(high.find(std::to_string(s.placement.count()) + " units are to be mounted more than 4 m"),
            std::string::npos);
  s.matrix.transceivers[s.placement.selected[0]].installed = true;
  EXPECT_EQ(test::count_of("410 cm, lift\n", text()), s.placement.count() - 1);
}

TEST(MountingSheet, SaysHowFarAUnitMayBeOff) {
  Supermarket s;
  for (LabelRow& label : s.matrix.labels) label.requirement *= 0.4;
  const std::vector<MountedUnit> sheet = mounting_sheet(s.input);
  const auto rows = test::read_csv(mounting_csv(s.input));
  std::size_t known = 0;
  for (std::size_t k = 0; k < sheet.size(); ++k) {
    const long cm = centimetres(sheet[k].tolerance);
    EXPECT_EQ(rows[k + 1][14], cm > 0 ? std::to_string(cm) : "");
    known += cm > 0 ? 1 : 0;
  }
  ASSERT_GT(known, 0U);
  const std::string html = test::static_report(s.input);
  EXPECT_EQ(test::count_of("<td data-label=\"Fine within\" class=\"n\"><div>–<", html), sheet.size() - known);
  EXPECT_EQ(test::count_of("<td data-label=\"Fine within\"", html), sheet.size());
  const Outcome outcome = outcome_of(s.matrix, s.placement);
  for (std::size_t i = 0; i < s.matrix.rows(); ++i)
    s.matrix.labels[i].requirement = outcome.labels[i].signal;  // no reserve
  EXPECT_EQ(test::static_report(s.input).find("Fine within"), std::string::npos);
}

TEST(MountingSheet, IsEmptyWithoutASelection) {
  Supermarket s;
  s.placement = {};
  s.placement.status = Status::infeasible;
  EXPECT_TRUE(mounting_sheet(s.input).empty());
  EXPECT_EQ(test::static_report(s.input).find("id=\"mounting\""), std::string::npos);
  EXPECT_EQ(test::read_csv(mounting_csv(s.input)).size(), 1U);
}

}  // namespace
}  // namespace shelfbeam
