#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/drawing/store_layer.hpp"

#include "unit/report/markup.hpp"
#include "unit/report/sample_store.hpp"

namespace shelfbeam {
namespace {

struct Drawn {
  PlanView view;
  std::vector<test::Element> elements;
  std::size_t count(const std::string& name) const {
    return static_cast<std::size_t>(
        std::count_if(elements.begin(), elements.end(), [&](const auto& e) { return e.name == name; }));
  }
};

// Square pillars of half a metre, too small for their ids, with these corners in a room of 25 x 18 m by
// default.
Drawn draw(const std::vector<Vec2>& corners, const Vec3& label = {1, 1, 1}, const Vec3& room = {25, 18, 4},
           const std::vector<Box>& others = {}, const std::set<std::string>& referenced = {}) {
  Store store = sample_store::empty_store("Pillars", room);
  for (const Box& box : others) store.fixtures.push_back({box, "fixtures"});
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const auto& [x, y] = corners[k];
    store.fixtures.push_back(
        {Box{"pillar-" + std::to_string(k), {x, y, 0}, {x + 0.5, y + 0.5, 4}, {}}, "fixtures"});
  }
  store.labels.push_back({Label{"L", label, {1, 0, 0}, {}}, "list"});
  store.transceivers.push_back({Transceiver{"T", {2, 2, 3}, {0, 0, -1}, 0, {}, false}, "list"});
  const Scene scene = make_scene(store);
  Drawn result{PlanView(scene), {}};
  SvgCanvas canvas;
  draw_fixture_ids(canvas, result.view, scene, {}, referenced);
  const test::Markup markup = test::read_markup(canvas.body());
  EXPECT_EQ(markup.problem, "");
  result.elements = markup.elements;
  return result;
}

double x_of(const Drawn& drawn, std::size_t nth) {
  for (const auto& element : drawn.elements)
    if (element.name == "text" && nth-- == 0) return std::stod(element.attributes.at("x"));
  return -1;
}

TEST(FixtureIds, StandBesideAPillar) {
  const Drawn alone = draw({{10, 8}});
  EXPECT_GT(x_of(alone, 0), alone.view.at(10.5, 8).x);
  EXPECT_EQ(alone.count("line"), 0U);
}

TEST(FixtureIds, DoNotCoverLabelMarks) {
  const double free = x_of(draw({{10, 8}}), 0);
  const Drawn labelled = draw({{10, 8}}, {10.5, 8.25, 1});
  EXPECT_NE(x_of(labelled, 0), free);
  EXPECT_EQ(labelled.count("line"), 0U);
}

TEST(FixtureIds, AvoidNeighbours) {
  const Drawn two = draw({{10, 8}, {11, 8}});
  EXPECT_LT(x_of(two, 0), two.view.at(10, 8).x);
  EXPECT_GT(x_of(two, 1), two.view.at(11.5, 8).x);
}

TEST(FixtureIds, HaveALeaderLineInCrowdedPlans) {
  std::vector<Vec2> crowd{{10, 8}};
  for (const double dx : {-0.7, 0.0, 0.7})
    for (const double dy : {-0.7, 0.0, 0.7})
      if (dx != 0 || dy != 0) crowd.push_back({10 + dx, 8 + dy});
  const Drawn drawn = draw(crowd);
  EXPECT_EQ(drawn.count("text"), 9U);
  EXPECT_GE(drawn.count("line"), 1U);
}

// Neighbours 3 m apart in a hall of 120 m: ids of the usual size would overlap.
TEST(FixtureIds, ShrinkWithTheScale) {
  std::vector<Vec2> row;
  row.reserve(9);
  for (int k = 0; k < 9; ++k) row.push_back({40.0 + 3 * k, 8});
  const Drawn hall = draw(row, {1, 1, 1}, {120, 18, 4});
  EXPECT_NEAR(hall.view.mark_share(), 1000.0 / 120 / 16, 1e-9);
  EXPECT_EQ(draw(row, {1, 1, 1}, {62, 18, 4}).view.mark_share(), 1);
  std::size_t groups = 0;
  for (const auto& element : hall.elements)
    if (element.name == "g") {
      ++groups;
      EXPECT_NE(element.attributes.at("style").find(",5.7px)"), std::string::npos)
          << element.attributes.at("style");
    }
  EXPECT_EQ(groups, 9U);
}

// The middle of a lowered ceiling belongs to the fixtures below it.
TEST(FixtureIds, OfALoweredCeilingStandInACornerFreeOfLabels) {
  const std::vector<Box> ceiling{{"ceiling", {5, 4, 2.7}, {15, 12, 2.8}, {}}};
  const Drawn free = draw({}, {1, 1, 1}, {25, 18, 4}, ceiling);
  const double middle = free.view.at(10, 8).x;
  EXPECT_GT(x_of(free, 0), free.view.at(5, 8).x);
  EXPECT_LT(x_of(free, 0), middle);
  EXPECT_GT(x_of(draw({}, {5.5, 11.8, 1}, {25, 18, 4}, ceiling), 0), middle);
}

// They are legible at any scale, and no other id covers them.
TEST(FixtureIds, ThatTheMountingSheetNamesAreDrawnLast) {
  const std::vector<Vec2> three{{4, 4}, {10, 8}, {16, 12}};
  const auto order = [](const Drawn& drawn) {
    std::string classes;
    for (const auto& element : drawn.elements)
      if (element.name == "text") classes += element.attributes.at("class") + "; ";
    return classes;
  };
  EXPECT_EQ(order(draw(three)), "fid mid; fid mid; fid mid; ");
  const Drawn named = draw(three, {1, 1, 1}, {25, 18, 4}, {}, {"pillar-0"});
  EXPECT_EQ(order(named), "fid mid; fid mid; fid mid ref; ");
  EXPECT_LT(x_of(named, 2), x_of(named, 0));
}

}  // namespace
}  // namespace shelfbeam
