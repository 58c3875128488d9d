// The keys of a type of transceivers that people read.

#include "shelfbeam/device/picture.hpp"
#include "shelfbeam/scene/light_keys.hpp"

#include "support/testing.hpp"
#include "unit/scene/same_scene.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

constexpr const char* picture =
    R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 3"><path d="M0 0h4"/></svg>)";

// The sample store, whose first type has these keys.
Json store_with_type(const Json& keys) {
  Json store = sample_store();
  store["transceiver_types"].front().update(keys);
  return store;
}

const TransceiverType& first_type(const Scene& scene) {
  return *std::ranges::find(scene.transceiver_types, "down", &TransceiverType::name);
}

TEST(UnitType, HasOrderNumberFixingAndPicture) {
  const TempFolder folder;
  folder.write("unit.svg", picture);
  const Json store = store_with_type(
      {{"order_number", "4711-B"}, {"fixing", "magnet on the T-bar"}, {"picture", "unit.svg"}});
  const Scene scene = scene_of(store, folder.path());
  const TransceiverType& type = first_type(scene);
  EXPECT_EQ(type.order_number, "4711-B");
  EXPECT_EQ(type.fixing, "magnet on the T-bar");
  EXPECT_EQ(type.picture, picture_uri(picture));
  const Scene same = make_scene(read_text(expect_same_scene(read(store, folder.path()))));
  EXPECT_EQ(first_type(same).picture, type.picture);
  EXPECT_EQ(first_type(same).fixing, type.fixing);
}

TEST(UnitType, HasKeysForPeopleThatAreNotPartOfTheHash) {
  const TempFolder folder;
  folder.write("unit.svg", picture);
  const Scene plain = scene_of(sample_store());
  const std::string text = resolved_store_json(read(sample_store()), plain);
  for (const char* key : {"order_number", "fixing", "picture"}) {
    EXPECT_EQ(text.find(key), std::string::npos);
    const Json store = store_with_type({{key, "unit.svg"}});
    const Scene scene = scene_of(store, folder.path());
    EXPECT_EQ(scene.store_hash, plain.store_hash) << key;
    EXPECT_EQ(light_keys(scene).transceivers, light_keys(plain).transceivers) << key;
    EXPECT_NE(resolved_store_json(read(store, folder.path()), scene), text) << key;
  }
  const Json all = store_with_type({{"order_number", "1"}, {"fixing", "2"}, {"picture", "unit.svg"}});
  EXPECT_EQ(scene_of(all, folder.path()).store_hash, plain.store_hash);
  EXPECT_NE(scene_of(store_with_type({{"cost", 77}})).store_hash, plain.store_hash) << "the control";
}

TEST(UnitType, RefusesLargePictures) {
  const TempFolder folder;
  folder.write("large.png", "\x89PNG\r\n\x1a\n" + std::string(max_picture_file, 'x'));
  expect_input_error([&] { scene_of(store_with_type({{"picture", "large.png"}}), folder.path()); },
                     "transceiver_types.down.picture", "large.png",
                     "has 500,008 bytes; the maximum of a picture is 500,000");
}

}  // namespace
}  // namespace shelfbeam::test
