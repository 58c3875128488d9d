#include "shelfbeam/report/place/shop_place.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/report/place/place_text.hpp"

#include "support/processor_time.hpp"
#include "unit/report/corner_shop.hpp"

namespace shelfbeam {
namespace {

std::string text_at(const Scene& scene, const Vec3& position) {
  return place_text(english(), ShopPlaces(scene).of(position));
}

// Two rows of shelves with an aisle of 2 m, below a lowered ceiling.
Store two_rows() {
  Store store = sample_store::empty_store("Rows", {20, 12, 4});
  const auto add = [&](Fixture fixture) { store.fixtures.push_back({std::move(fixture), "fixtures"}); };
  add(Box{"G3", {3, 4, 0}, {9, 5, 1.8}, {}});
  add(Box{"G4", {3, 7, 0}, {9, 8, 1.8}, {}});
  add(Box{"C2", {16, 4, 0}, {17, 5, 1}, {}});
  add(Box{"canopy", {2, 3, 3.2}, {10, 9, 3.3}, {}});
  sample_store::add_devices(store, {3.1, 3.9, 1}, {15, 8, 3.9});
  return store;
}

TEST(ShopPlace, IsAmongTheFixturesOnTheFloor) {
  const Scene scene = make_scene(two_rows());
  EXPECT_EQ(text_at(scene, {6, 4.5, 3}), "above G3");
  EXPECT_EQ(text_at(scene, {6, 6.2, 3}), "over the aisle between G3 and G4");
  EXPECT_EQ(text_at(scene, {6, 5.2, 3.9}), "over the aisle between G3 and G4") << "the canopy is not a place";
  EXPECT_EQ(text_at(scene, {6, 6, 1.5}), "between G3 and G4");
  EXPECT_EQ(text_at(scene, {6, 2, 3}), "over the aisle between G3 and the wall");
  EXPECT_EQ(text_at(scene, {6, 5.05, 1.5}), "at G3") << "mounted on its face";
  EXPECT_EQ(text_at(scene, {15, 4.5, 3}), "beside C2") << "the wall is too far for an aisle";
  EXPECT_EQ(text_at(scene, {12.5, 10, 3}), "") << "far from everything";
}

TEST(ShopPlace, EndsAtAWall) {
  Store store = two_rows();
  EXPECT_EQ(text_at(make_scene(store), {10.5, 4.5, 3}), "beside G3");
  store.room->shape.inner_walls = {{"W", {9.5, 3}, {9.5, 9}, 0.1, {}, {}}};
  store.room->inner_walls = {{MaterialId{0}, {}}};
  EXPECT_EQ(text_at(make_scene(store), {10.5, 4.5, 3}), "") << "the wall hides G3";
  EXPECT_EQ(text_at(make_scene(store), {9.2, 4.5, 3}), "beside G3") << "on its own side of the wall";
}

TEST(ShopPlace, IsFoundAsFastWithManyFixturesElsewhere) {
  Store store = sample_store::empty_store("Bins", {200, 100, 4});
  for (int k = 0; k < 20'000; ++k) {
    const double x = k % 200 + 0.2, y = k / 200 + 0.2;
    store.fixtures.push_back({Box{fmt::format("B{}", k), {x, y, 0}, {x + 0.4, y + 0.4, 1}, {}}, "fixtures"});
  }
  sample_store::add_devices(store, {1.8, 1.8, 1}, {15, 8, 3.9});
  const Scene scene = make_scene(store);
  const ShopPlaces places(scene);
  const test::ProcessorTime time;
  for (int k = 0; k < 500; ++k) EXPECT_NE(places.of({k % 99 + 0.9, k % 59 + 0.9, 3}).fixture, "");
  EXPECT_LT(time.seconds(), 0.2);
}

TEST(ShopPlace, IsAZoneWithoutAFixture) {
  Store store = test::corner_shop_store();
  std::erase_if(store.fixtures, [](const auto& listed) { return id_of(listed.value) != "column"; });
  EXPECT_EQ(text_at(make_scene(store), {2, 8, 2.5}), "under the ceiling at 2.60 m");
  EXPECT_EQ(text_at(make_scene(store), {5, 8, 3}), "");
}

TEST(ShopPlace, IsInTheLanguageOfTheStore) {
  const Scene scene = make_scene(two_rows());
  EXPECT_EQ(place_text(Words(Language::german), ShopPlaces(scene).of({6, 6.2, 3})),
            "über dem Gang zwischen G3 und G4");
}

}  // namespace
}  // namespace shelfbeam
