// Tests the states of a shop that changes in the data of the 3-D view.

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/report/data/shop_states.hpp"
#include "shelfbeam/report/viewer/page_signals.hpp"
#include "shelfbeam/scene/states/store_states.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/temp_folder.hpp"
#include "unit/report/page_reader.hpp"
#include "unit/report/sample_store.hpp"

namespace shelfbeam {
namespace {

constexpr std::uint64_t seed = 5;

// Three people, a pallet, and doors that are always open at one fixture and always closed at the other.
Store changing_store() {
  Store store = sample_store::empty_store("Kiosk", {8, 6, 3});
  store.materials.push_back({"glass", ThinDielectric{}});
  for (const double y : {1.5, 4.0}) {
    Gondola gondola =
        sample_store::gondola(y < 2 ? "G1" : "G2", {2, y}, 3, 0.6, {0.5, 1.2}, 0, {Face::front});
    gondola.doors = MaterialId{1};
    gondola.variation.open = y < 2 ? 0 : 1;
    store.fixtures.push_back({std::move(gondola), "fixtures"});
  }
  sample_store::add_devices(store, {7.9, 3, 1}, {4, 3, 2.9});
  const PlanArea area{std::string("room")};
  StoreVariation& variation = store.variation.emplace();
  variation.boxes.push_back({"person", area, UniformNumber{3, 3}, {0.5, 0.3, 1.75}, MaterialId{0}, true});
  variation.boxes.push_back({"pallet", area, Presence{1}, {1.2, 0.8, 1.4}, MaterialId{0}, false});
  return store;
}

struct ChangingShop {
  Store store = changing_store();
  Scene scene = make_scene(store);
  SignalMatrix matrix = sample_store::matrix_of(scene);
  CertifiedPlan plan{sample_store::cover(matrix)};

  ChangingShop() {
    matrix.provenance.seed = seed;
    plan.availability.emplace().shown = {{1'000'000, {}}, {1'000'217, {0, 3}}};
  }
  ReportInput input() const { return {scene, matrix, plan, false, shop_states(store, scene, matrix, plan)}; }
};

std::string packed(const ReportInput& input) {
  return pack_store(ReportData(input), SignalScale({0.1, 1}));
}

TEST(PageStates, HavePeopleObjectsAndDoorsOfTheirScenes) {
  const ChangingShop shop;
  const ReportInput input = shop.input();
  const test::PageReader page(packed(input));
  const auto outline = page.get<float>("block_outline"), height = page.get<float>("block_height");
  const StoreStates states(shop.store, shop.scene, seed);
  std::size_t block = 0, equal_states = 0;
  ASSERT_EQ(page.about["states"].size(), 2U);
  for (const auto& state : page.about["states"]) {
    const Scene drawn = make_scene(states.state(state["number"]));
    ASSERT_EQ(state["blocks"], 4U);
    std::size_t boxes = 0;
    for (const Part& expected : drawn.parts) {
      if (expected.fixture < shop.scene.fixtures.size()) continue;
      for (std::size_t at = 0; at < 8; ++at)
        EXPECT_FLOAT_EQ(outline.at(8 * block + at),
                        static_cast<float>(expected.footprint.at(at / 2)[at % 2]));
      EXPECT_EQ(height.at(2 * block), 0);
      EXPECT_FLOAT_EQ(height.at(2 * block + 1), static_cast<float>(expected.top));
      ++block;
      ++boxes;
    }
    EXPECT_EQ(boxes, 4U);
    EXPECT_EQ(state["open"], std::vector<int>{1});
    equal_states += outline.at(0) == outline.at(8 * block - 32) ? 1 : 0;
  }
  EXPECT_EQ(equal_states, 1U) << "the states differ";
  EXPECT_EQ(8 * block, outline.size());
  EXPECT_EQ(page.about["states"][0]["missed"], std::vector<int>());
  EXPECT_EQ(page.about["states"][1]["missed"], (std::vector<int>{0, 3}));
  std::size_t doors = 0;
  for (const std::uint8_t look : page.get<std::uint8_t>("part_look")) doors += look == 3 ? 1 : 0;
  const auto fixtures = page.get<std::uint32_t>("door_fixture");
  ASSERT_EQ(fixtures.size(), doors);
  EXPECT_EQ(fixtures.front(), 0U);
  EXPECT_EQ(fixtures.back(), 1U);
}

// 'report' reads the resolved store from the folder of the plan.
TEST(PageStates, AreTheSameFromTheResolvedStore) {
  const ChangingShop shop;
  const test::TempFolder folder;
  const Store store = read_store(folder.write("store.json", resolved_store_json(shop.store, shop.scene)));
  const Scene scene = make_scene(store);
  const ReportInput again{scene, shop.matrix, shop.plan, false,
                          shop_states(store, scene, shop.matrix, shop.plan)};
  EXPECT_EQ(packed(again), packed(shop.input()));
}

// Reused signals may have another seed than the plan.
TEST(PageStates, HaveTheSeedOfThePlan) {
  ChangingShop shop;
  const std::string page = packed(shop.input());
  shop.matrix.provenance.seed = seed + 1;
  EXPECT_NE(packed(shop.input()), page) << "without a seed of the plan";
  shop.plan.seed = seed;
  EXPECT_EQ(packed(shop.input()), page);
}

TEST(PageStates, AreOmittedForAShopThatDoesNotChange) {
  ChangingShop shop;
  shop.plan.availability.reset();
  EXPECT_TRUE(shop.input().states.empty());
  EXPECT_FALSE(test::PageReader(packed(shop.input())).about.contains("states"));
  EXPECT_ANY_THROW(test::PageReader(packed(shop.input())).get<float>("block_outline"));
}

}  // namespace
}  // namespace shelfbeam
