// The keys of a type of transceivers that people read.

#include <cstddef>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/device/picture.hpp"
#include "shelfbeam/scene/light_keys.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using test::TempFolder;

constexpr const char* picture =
    R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 4 3"><path d="M0 0h4"/></svg>)";

// The sample store, whose first type has these keys.
Json store_with_type(const Json& keys) {
  Json store = test::sample_store();
  store["transceiver_types"].front().update(keys);
  return store;
}

const TransceiverType& first_type(const Scene& scene, const Json& store) {
  const std::string& name = store["transceiver_types"].begin().key();
  for (const TransceiverType& type : scene.transceiver_types)
    if (type.name == name) return type;
  throw std::logic_error("the type is missing");
}

TEST(UnitType, HasOrderNumberFixingAndPicture) {
  const TempFolder folder;
  folder.write("unit.svg", picture);
  const Json store = store_with_type(
      {{"order_number", "4711-B"}, {"fixing", "magnet on the T-bar"}, {"picture", "unit.svg"}});
  const Scene scene = test::scene_of(store, folder.path());
  const TransceiverType& type = first_type(scene, store);
  EXPECT_EQ(type.order_number, "4711-B");
  EXPECT_EQ(type.fixing, "magnet on the T-bar");
  EXPECT_EQ(type.picture, picture_uri(picture));

  // The resolved store needs no file, and is the same again.
  const TempFolder elsewhere;
  const std::string resolved = resolved_store_json(test::read_text(store.dump(), folder.path()), scene);
  const Store again = parse_store(resolved, "resolved.json", elsewhere.path());
  const Scene same = make_scene(again);
  EXPECT_EQ(first_type(same, store).picture, type.picture);
  EXPECT_EQ(first_type(same, store).fixing, type.fixing);
  EXPECT_EQ(resolved_store_json(again, same), resolved);
}

TEST(UnitType, HasKeysForPeopleThatAreNotPartOfTheHash) {
  const TempFolder folder;
  folder.write("unit.svg", picture);
  const Scene plain = test::scene_of(test::sample_store());
  const std::string text = resolved_store_json(test::read_text(test::sample_store().dump()), plain);
  for (const char* key : {"order_number", "fixing", "picture"}) {
    EXPECT_EQ(text.find(key), std::string::npos);
    const Json store = store_with_type({{key, "unit.svg"}});
    const Scene scene = test::scene_of(store, folder.path());
    EXPECT_EQ(scene.store_hash, plain.store_hash) << key;
    EXPECT_EQ(light_keys(scene).transceivers, light_keys(plain).transceivers) << key;
    EXPECT_NE(resolved_store_json(test::read_text(store.dump(), folder.path()), scene), text) << key;
  }
  const Json all = store_with_type({{"order_number", "1"}, {"fixing", "2"}, {"picture", "unit.svg"}});
  EXPECT_EQ(test::scene_of(all, folder.path()).store_hash, plain.store_hash);
  EXPECT_NE(test::scene_of(store_with_type({{"cost", 77}})).store_hash, plain.store_hash) << "the control";
}

TEST(UnitType, RefusesFilesThatAreNoPictures) {
  const TempFolder folder;
  folder.write("unit.gif", "GIF89a");
  folder.write("large.png", "\x89PNG\r\n\x1a\n" + std::string(max_picture_file, 'x'));
  const auto expect_refused = [&](const char* value, const auto&... parts) {
    test::expect_input_error([&] { test::scene_of(store_with_type({{"picture", value}}), folder.path()); },
                             "transceiver_types.down.picture", parts...);
  };
  expect_refused("unit.gif", "unit.gif", "is not a PNG, JPEG or SVG picture");
  expect_refused("large.png", "large.png", "has 500,008 bytes; the maximum of a picture is 500,000");
  expect_refused("missing.png", "does not exist");
  expect_refused("../unit.png", "outside the folder");
  expect_refused("data:text/html;base64,AAAA", "is not a data URI");
  expect_refused("data:image/png;base64,A\"A=", "is not a data URI");
  test::expect_input_error([] { test::scene_of(store_with_type({{"order_number", ""}})); }, "order_number");
  test::expect_input_error([] { test::scene_of(store_with_type({{"fixing", 3}})); }, "fixing");
}

}  // namespace
}  // namespace shelfbeam
