#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/scene/light_keys.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/expect_input_error.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;
using test::Json;
using test::sample_store;
using test::scene_of;

Scene scene_with(const char* key, const Json& ids) {
  Json store = sample_store();
  store["transceivers"][key] = ids;
  return scene_of(store);
}

template <class Is>
std::vector<std::string> ids_of(const std::vector<Transceiver>& units, const Is& is) {
  std::vector<std::string> ids;
  for (const Transceiver& unit : units)
    if (is(unit)) ids.push_back(unit.id);
  return ids;
}

std::vector<std::string> pinned(const Scene& scene) {
  return ids_of(scene.transceivers, [](const Transceiver& unit) { return unit.pinned; });
}

TEST(GivenUnits, ArePinnedByIdOrPattern) {
  const Scene scene = scene_with("pinned", {"T2", "G1-4-*", "G1-4-3", "T1"});
  EXPECT_EQ(pinned(scene), (std::vector<std::string>{"G1-4-1", "G1-4-2", "G1-4-3", "T2"}))
      << "T1 is installed, so it is free";
}

TEST(GivenUnits, AreExcludedAndKeptForTheResolvedStore) {
  const Scene all = scene_of(sample_store()), scene = scene_with("excluded", {"G1-?-2", "T2"});
  EXPECT_EQ(scene.transceivers.size() + scene.excluded.size(), all.transceivers.size());
  EXPECT_EQ(ids_of(scene.excluded, [](const auto&) { return true; }),
            (std::vector<std::string>{"G1-1-2", "G1-2-2", "G1-3-2", "G1-4-2", "T2"}));
  EXPECT_NE(scene.store_hash, all.store_hash);
}

TEST(GivenUnits, RemainInTheResolvedStore) {
  Json json = sample_store();
  json["transceivers"]["pinned"] = {"G1-4-*"};
  json["transceivers"]["excluded"] = {"T2", "G1-2-*"};
  const Store store = test::read_text(json.dump());
  const Scene scene = make_scene(store);
  const std::string resolved = resolved_store_json(store, scene);
  const Store again = test::read_text(resolved);
  const Scene same = make_scene(again);
  EXPECT_EQ(pinned(same), pinned(scene));
  EXPECT_EQ(same.excluded.size(), scene.excluded.size());
  EXPECT_EQ(same.store_hash, scene.store_hash);
  EXPECT_EQ(resolved_store_json(again, same), resolved);
  const Json units = Json::parse(resolved)["transceivers"];
  EXPECT_EQ(units["pinned"].size(), 3u);
  EXPECT_EQ(units["excluded"].size(), scene.excluded.size());
  EXPECT_FALSE(Json::parse(resolved_store_json(test::read_text(sample_store().dump()),
                                               scene_of(sample_store())))["transceivers"]
                   .contains("pinned"));
}

TEST(GivenUnits, MustExist) {
  for (const char* key : {"pinned", "excluded"}) {
    const std::string where = std::string("transceivers.") + key;
    expect_input_error([&] { scene_with(key, {"T2", "G1-4-33"}); },
                       where + "[1]: ", "did you mean 'G1-4-3'?");
    expect_input_error([&] { scene_with(key, {"*x*"}); }, where + "[0]: ", "'*x*' matches no transceiver");
    expect_input_error([&] { scene_with(key, Json::array({7})); }, where + "[0]");
  }
}

TEST(GivenUnits, MayNotBeKeptOut) {
  expect_input_error([] { scene_with("pinned", {"G1-1-1"}); }, "transceivers.pinned[0]: ", "'keep_out'");
  EXPECT_TRUE(scene_with("excluded", {"G1-1-1"}).excluded.empty()) << "has no candidate already";
}

TEST(GivenUnits, MayNotContradictEachOther) {
  expect_input_error([] { scene_with("excluded", {"T*"}); },
                     "transceivers.excluded[0]: ", "excludes the installed unit 'T1'");
  Json json = sample_store();
  json["transceivers"]["pinned"] = {"G1-2-*"};
  json["transceivers"]["excluded"] = {"G1-*-2"};
  expect_input_error([&] { scene_of(json); },
                     "transceivers.excluded[0]: ", "excludes the pinned unit 'G1-2-2'");
  json = sample_store();
  Json tilted = json["transceivers"]["grids"][0];
  tilted["axis"] = {0, 1, -1};
  json["transceivers"]["grids"].push_back(tilted);
  json["transceivers"]["pinned"] = {"G1-4-3", "G2-4-3"};
  expect_input_error([&] { scene_of(json); },
                     "transceivers.pinned[1]: ", "'G2-4-3' is pinned at the mounting point of 'G1-4-3'");
  json = sample_store();
  json["transceivers"].erase("installed");
  json["transceivers"]["excluded"] = {"G*", "T*"};
  expect_input_error([&] { scene_of(json); }, "transceivers.excluded[1]: ", "leaves no candidate");
}

std::vector<std::string> selected(const Scene& scene) {
  return ids_of(scene.transceivers, [](const Transceiver& unit) { return unit.selected; });
}

// The choice is kept, and binds nothing: neither the hash of the store nor its light depends on it.
TEST(GivenUnits, AreSelectedWithoutAnEffect) {
  Json json = sample_store();
  const Scene before = scene_of(json);
  json["transceivers"]["selected"] = {"T2", "G1-4-3", "T1"};
  const Store store = test::read_text(json.dump());
  const Scene scene = make_scene(store);
  EXPECT_EQ(selected(scene), (std::vector<std::string>{"G1-4-3", "T1", "T2"}));
  EXPECT_EQ(ids_of(scene.transceivers, [](const Transceiver& unit) { return unit.is_chosen(); }),
            selected(scene))
      << "T1 is installed, too";
  EXPECT_EQ(scene.store_hash, before.store_hash);
  EXPECT_EQ(light_keys(scene).light_hash, light_keys(before).light_hash);
  EXPECT_EQ(light_keys(scene).transceivers, light_keys(before).transceivers);
  const std::string resolved = resolved_store_json(store, scene);
  EXPECT_EQ(selected(make_scene(test::read_text(resolved))), selected(scene));
  EXPECT_EQ(hash_of_resolved(resolved), scene.store_hash);
  json["transceivers"]["pinned"] = {"T2"};
  EXPECT_NE(scene_of(json).store_hash, before.store_hash) << "a control: a pin binds plans";
}

TEST(GivenUnits, OfAChoiceAreNamedByTheirIds) {
  expect_input_error([] { scene_with("selected", {"G1-*"}); }, "transceivers.selected[0]",
                     "unknown transceiver");
  Json store = sample_store();
  store["transceivers"]["selected"] = {"T2"};
  store["transceivers"]["excluded"] = {"T?"};
  store["transceivers"].erase("installed");
  expect_input_error([&] { scene_of(store); }, "transceivers.excluded[0]", "excludes the selected unit");
}

}  // namespace
}  // namespace shelfbeam
