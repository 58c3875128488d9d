#include "shelfbeam/report/mounting/mounting_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/report/data/walking_order.hpp"
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
  // The slanted wall is where y = x - 2: from x = 8 at y = 3 to x = 5.
  expect_reference(references_of(scene, {8, 3, 3})[0], Side::left, Kind::fixture, "wall", 3);
  // Walls that are more than 8 m away give way to fixtures below.
  expect_reference(references_of(scene, {10.5, 19, 3.9})[1], Side::top, Kind::fixture, "table", 1);
  expect_reference(references_of(scene, {10.5, 21, 3.9})[1], Side::bottom, Kind::end, "table", 1);
  EXPECT_EQ(name_of(english(), references_of(scene, {10.5, 21, 3.9})[1]), "bottom side of table");
  EXPECT_EQ(name_of(english(), references_of(scene, {2, 27, 3.9})[0]), "wall at the left");
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
