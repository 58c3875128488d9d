#include "shelfbeam/scene/light_keys.hpp"

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

Scene scene_with(const char* key, const Json& ids) {
  Json store = sample_store();
  store["transceivers"][key] = ids;
  return scene_of(store);
}

// The ids of the units with a mark.
template <class Mark>
std::string ids_with(const Mark& mark, const Scene& scene) {
  std::vector<Transceiver> units = scene.transceivers;
  std::erase_if(units, [&](const Transceiver& unit) { return !std::invoke(mark, unit); });
  return ids_of(units);
}

TEST(GivenUnits, ArePinnedByIdOrPattern) {
  const Scene scene = scene_with("pinned", {"T2", "G1-4-*", "G1-4-3", "T1"});
  EXPECT_EQ(ids_with(&Transceiver::pinned, scene), "G1-4-1 G1-4-2 G1-4-3 T2 ")
      << "T1 is installed, so it is free";
}

TEST(GivenUnits, AreExcludedAndKeptForTheResolvedStore) {
  const Scene all = scene_of(sample_store()), scene = scene_with("excluded", {"G1-?-2", "T2"});
  EXPECT_EQ(scene.transceivers.size() + scene.excluded.size(), all.transceivers.size());
  EXPECT_EQ(ids_of(scene.excluded), "G1-1-2 G1-2-2 G1-3-2 G1-4-2 T2 ");
  EXPECT_NE(scene.store_hash, all.store_hash);
  EXPECT_TRUE(scene_with("excluded", {"G1-1-1"}).excluded.empty()) << "has no candidate already";
}

TEST(GivenUnits, RemainInTheResolvedStore) {
  Json json = sample_store();
  json["transceivers"]["pinned"] = {"G1-4-*"};
  json["transceivers"]["excluded"] = {"T2", "G1-2-*"};
  const Scene scene = scene_of(json);
  const Json resolved = Json::parse(expect_same_scene(read(json)));
  EXPECT_EQ(ids_with(&Transceiver::pinned, scene_of(resolved)), "G1-4-1 G1-4-2 G1-4-3 ");
  EXPECT_EQ(scene_of(resolved).excluded.size(), scene.excluded.size());
  EXPECT_EQ(resolved["transceivers"]["pinned"].size(), 3u);
  EXPECT_EQ(resolved["transceivers"]["excluded"].size(), scene.excluded.size());
  EXPECT_FALSE(Json::parse(expect_same_scene(read(sample_store())))["transceivers"].contains("pinned"));
}

// The choice is kept, and binds nothing: neither the hash of the store nor its light depends on it.
TEST(GivenUnits, AreSelectedWithoutAnEffect) {
  Json json = sample_store();
  const Scene before = scene_of(json);
  json["transceivers"]["selected"] = {"T2", "G1-4-3", "T1"};
  const Scene scene = scene_of(json);
  EXPECT_EQ(ids_with(&Transceiver::selected, scene), "G1-4-3 T1 T2 ");
  EXPECT_EQ(ids_with(&Transceiver::is_chosen, scene), "G1-4-3 T1 T2 ") << "T1 is installed, too";
  EXPECT_EQ(scene.store_hash, before.store_hash);
  EXPECT_EQ(light_keys(scene).light_hash, light_keys(before).light_hash);
  EXPECT_EQ(light_keys(scene).transceivers, light_keys(before).transceivers);
  const std::string resolved = expect_same_scene(read(json));
  EXPECT_EQ(ids_with(&Transceiver::selected, make_scene(read_text(resolved))), "G1-4-3 T1 T2 ");
  EXPECT_EQ(hash_of_resolved(resolved), scene.store_hash);
  json["transceivers"]["pinned"] = {"T2"};
  EXPECT_NE(scene_of(json).store_hash, before.store_hash) << "a control: a pin binds plans";
}

}  // namespace
}  // namespace shelfbeam::test
