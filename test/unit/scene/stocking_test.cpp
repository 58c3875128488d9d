#include <algorithm>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/scene/build/fixture_geometry.hpp"

#include "unit/scene/shelving.hpp"
#include "unit/scene/solids.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using test::scene_of;
using test::solids_of;

const std::vector<double> levels = {0, 0.1, 0.25, 0.5, 0.5001, 0.8, 0.95, 1};

bool only_adds(const std::vector<double>& less, const std::vector<double>& more) {
  return std::equal(less.begin(), less.end(), more.begin(), [](double a, double b) { return a <= b; });
}

TEST(Stocking, MoreOnlyAdds) {
  for (const std::size_t count : {1u, 2u, 7u, 40u, 1000u})
    for (std::size_t k = 1; k < levels.size(); ++k)
      EXPECT_TRUE(only_adds(stock(count, levels[k - 1], "A-front-1"), stock(count, levels[k], "A-front-1")))
          << count << " places at " << levels[k];
  // A draw of its own for every level of stocking is what the same check must refuse.
  int refused = 0;
  for (std::size_t k = 3; k < levels.size(); ++k)
    refused += only_adds(stock(40, levels[k - 1], "one"), stock(40, levels[k] - 0.05, "another")) ? 0 : 1;
  EXPECT_GT(refused, 3);
}

TEST(Stocking, FillsTheShareAskedFor) {
  for (const double stocking : levels) {
    const auto fill = stock(200, stocking, "B-back-3");
    const auto filled = std::count_if(fill.begin(), fill.end(), [](double f) { return f > 0; });
    EXPECT_EQ(filled, std::lround(200 * stocking));
    for (const double f : fill)
      EXPECT_TRUE(f == 0 || (f >= stocking && f <= 1))
          << "a place is empty, or as full as the shelf or fuller";
  }
  EXPECT_EQ(stock(50, 0, "x"), std::vector<double>(50, 0.0));
  EXPECT_EQ(stock(50, 1, "x"), std::vector<double>(50, 1.0));
  EXPECT_EQ(stock(20, 0.5, "x"), stock(20, 0.5, "x"));
  EXPECT_NE(stock(20, 0.5, "x"), stock(20, 0.5, "y")) << "every row has an order of its own";
}

// Height of the goods in each place that has some.
std::map<std::array<double, 3>, double> goods_of(const Json& base, double stocking) {
  Json store = base;
  store["fixtures"][0]["stocking"] = stocking;
  std::map<std::array<double, 3>, double> heights;
  for (const auto& block : solids_of(scene_of(store), PartKind::goods))
    heights[{block.part.footprint[0][0], block.part.footprint[0][1], block.part.bottom}] =
        block.part.top - block.part.bottom;
  return heights;
}

TEST(Stocking, OfFixturesOnlyAddsGoods) {
  for (const Json& base : {test::gondola_store(), test::freezer_store()}) {
    auto before = goods_of(base, 0);
    EXPECT_TRUE(before.empty());
    for (const double stocking : {0.2, 0.5, 0.7, 1.0}) {
      const auto now = goods_of(base, stocking);
      EXPECT_GT(now.size(), before.size());
      for (const auto& [place, height] : before) {
        ASSERT_EQ(now.count(place), 1u) << "goods moved or vanished at stocking " << stocking;
        EXPECT_GE(now.at(place), height);
      }
      before = now;
    }
  }
  // Another fixture is stocked in another order, which the check above would not let pass.
  Json renamed = test::gondola_store();
  renamed["fixtures"][0]["id"] = "B";
  EXPECT_NE(goods_of(renamed, 0.5), goods_of(test::gondola_store(), 0.5));
}

}  // namespace
}  // namespace shelfbeam
