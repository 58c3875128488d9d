#include "shelfbeam/base/provenance.hpp"
#include "shelfbeam/scene/label/description_column.hpp"

#include "support/testing.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

// Two gondolas, the second one turned, and a freezer.
Json shelving_store() {
  const Json both{{"length", 3}, {"faces", nullptr}};
  Json store = store_with({shelves({{"id", "A"}, {"at", {2, 5}}}), shelves({{"id", "B"}, {"at", {5, 5}}}),
                           R"({"type": "freezer", "id": "F", "at": [5, 9], "rotation_deg": 90, "length": 2,
    "depth": 0.8, "height": 0.9, "material": "steel", "labels": {"type": "small", "count": 2, "on_top": true,
                                                                  "faces": ["front", "back", "left", "right"]}})"_json});
  for (std::size_t k : {0, 1}) store["fixtures"][k].merge_patch(both);
  store["fixtures"][0]["labels"]["spacing"] = 1;
  store["fixtures"][1].update(
      R"({"rotation_deg": 30, "labels": {"type": "small", "positions": [0, 3], "hook": 0.2}})"_json);
  store["labels"] = Json::array();
  return store;
}

Scene resolved_scene(const Json& store, const std::filesystem::path& folder) {
  const Store given = read(store, folder);
  return make_scene(parse_store(resolved_store_json(given, make_scene(given)), "resolved.json", folder));
}

void expect_places(const Scene& scene, const Scene& expected) {
  ASSERT_EQ(scene.labels.size(), expected.labels.size());
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    expect_place(scene.labels[i], expected.labels[i].place);
    EXPECT_EQ(scene.labels[i].description, expected.labels[i].description);
  }
}

TEST(LabelPlace, OfGeneratedLabelsIsThatOfTheStore) {
  const TempFolder folder;
  const Json store = shelving_store();
  const Scene scene = scene_of(store);
  ASSERT_EQ(scene.labels.size(), 12U + 8U + 8U);
  EXPECT_EQ(scene.labels[9].id, "A-back-2-1");
  expect_place(scene.labels[9], {.fixture = "A", .face = Face::back, .board = 2, .along = 0.5});
  expect_place(scene.labels[12], {.fixture = "B", .face = Face::front, .board = 1, .along = 0});
  EXPECT_EQ(scene.labels[26].id, "F-right-1-1");
  expect_place(scene.labels[26],
               {.fixture = "F", .face = Face::right, .on_top = true, .board = 1, .along = 0.2});
  expect_places(resolved_scene(store, folder.path()), scene);
}

TEST(LabelPlace, OfListedLabelsFollowsFromTheirPositions) {
  Json store = store_with(R"([
    {"type": "gondola", "id": "A", "at": [2, 5], "length": 3, "depth": 0.9, "height": 1.8, "material": "steel",
     "shelves": [0.4, 0.9]},
    {"type": "box", "id": "table", "at": [6, 5, 0], "size": [1.2, 0.8, 0.75], "rotation_deg": 90,
     "material": "steel", "labels": [
       {"id": "card", "position": [0.6, 0.4, 0.9], "normal": [0, -1, 0.5], "type": "small"},
       {"id": "edge", "position": [0.3, -0.01, 0.7], "normal": [0, -1, 0], "type": "small"}]},
    {"type": "box", "id": "beam", "min": [2, 4, 2.8], "max": [5, 7, 2.95], "material": "steel"},
    {"type": "cylinder", "id": "column", "at": [9, 9], "radius": 0.3, "top": 3, "material": "steel"}])"_json);
  const auto add = [&](const char* id, const Vec3& at, const Vec3& normal) {
    store["labels"].push_back({{"id", id},
                               {"position", {at.x, at.y, at.z}},
                               {"normal", {normal.x, normal.y, normal.z}},
                               {"type", "small"}});
  };
  store["labels"] = Json::array();
  add("shelf", {3, 4.98, 0.88}, {0, -1, 0});
  add("below the beam", {3, 5.91, 0.4}, {0, 1, 0.2});
  add("on the column", {9, 8.65, 1.5}, {0, -1, 0});
  add("at the wall", {4, 0.02, 1.5}, {0, 1, 0});
  add("in the air", {8, 3, 2}, {0, -1, 0});
  const Scene scene = scene_of(store);
  const auto expect = [&](std::size_t k, const char* id, const LabelPlace& known) {
    EXPECT_EQ(scene.labels[k].id, id);
    expect_place(scene.labels[k], known);
  };
  expect(0, "table-card", {.fixture = "table", .face = Face::front, .on_top = true, .along = 0.6});
  expect(1, "table-edge", {.fixture = "table", .face = Face::front, .along = 0.3});
  expect(2, "shelf", {.fixture = "A", .face = Face::front, .board = 2, .along = 1});
  expect(3, "below the beam", {.fixture = "A", .face = Face::back, .board = 1, .along = 1});
  expect(4, "on the column", {.fixture = "column"});
  EXPECT_EQ(scene.labels[5].place.fixture, "");
  ASSERT_TRUE(scene.labels[5].place.wall.has_value());
  const OuterWall wall = scene.room->wall(*scene.labels[5].place.wall);
  EXPECT_EQ(wall.from[1], 0);
  EXPECT_EQ(wall.to[1], 0);
  EXPECT_FALSE(scene.labels[6].place.is_known());
}

TEST(LabelDescription, ComesFromColumnsAndKeysButNotIntoTheHash) {
  const TempFolder folder;
  Json store = shelving_store();
  store["planogram"] = {{"file", "p.csv"}, {"type", "small"}};
  const auto labels = [&](const std::string& header, const std::string& first) {
    folder.write("p.csv", "article,fixture,face,level,x" + header + "\n1,A,front,2,1," + first +
                              "\n2,A,front,2,2,,\n");
    return scene_of(store, folder.path());
  };
  const Scene plain = labels(",facings,colour", "3,red");
  const std::size_t first = plain.labels.size() - 2;
  EXPECT_EQ(plain.labels[first].description, "");
  expect_place(plain.labels[first], {.fixture = "A", .face = Face::front, .board = 2, .along = 1});
  for (const auto& [header, value] : {std::pair{",description,x2", "Rye bread,7"},
                                      {",Name,description", "no,Rye bread"},
                                      {",ARTICLE_NAME,x2", "\" Rye\n\tbread \",7"},
                                      {",Product_Name,x2", "Rye bread,7"}}) {
    const Scene scene = labels(header, value);
    EXPECT_EQ(scene.labels[first].description, "Rye bread") << header;
    EXPECT_EQ(scene.labels[first + 1].description, "") << header;
    EXPECT_EQ(scene.store_hash, plain.store_hash) << header;
    expect_places(resolved_scene(store, folder.path()), scene);
  }
  // Everything else is part of the hash.
  const std::string text = resolved_store_json(read(store, folder.path()), labels(",name,x2", "Rye bread,7"));
  EXPECT_EQ(hash_of_resolved(text), plain.store_hash);
  EXPECT_NE(content_hash(text), plain.store_hash);
  std::string other = text;
  other.replace(other.find("\"id\": \"2\""), 9, "\"id\": \"3\"");
  EXPECT_NE(hash_of_resolved(other), plain.store_hash);
  store["labels"] = R"([{"id": "poster", "description": "Offers", "position": [1, 1, 1], "normal": [0, 1, 0],
                         "type": "small"}])"_json;
  EXPECT_EQ(scene_of(store, folder.path()).labels[first].description, "Offers");
  store["labels"] = {{"csv", "labels.csv"}};
  folder.write("labels.csv",
               "id,x,y,z,nx,ny,nz,type,product\nposter,1,1,1,0,1,0,small,Offers\nstand,1,1,2,0,1,0,small\n");
  const Scene listed = scene_of(store, folder.path());
  EXPECT_EQ(listed.labels[first].description, "Offers");
  EXPECT_EQ(listed.labels[first + 1].description, "");
}

TEST(LabelDescription, IsOneLineOfLimitedLength) {
  EXPECT_EQ(description_of(""), "");
  EXPECT_EQ(description_of(" \n\t "), "");
  EXPECT_EQ(description_of("  Käse,\r\n  jung\u202e "), "Käse, jung");
  EXPECT_EQ(description_of("\xff"), "");
  EXPECT_LE(description_of(std::string(1000, 'x')).size(), 205U);
  EXPECT_EQ(description_of(std::string(200, 'x')), std::string(200, 'x'));
}

}  // namespace
}  // namespace shelfbeam::test
