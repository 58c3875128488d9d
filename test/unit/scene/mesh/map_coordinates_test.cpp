#include "support/testing.hpp"
#include "unit/scene/mesh_files.hpp"
#include "unit/scene/same_scene.hpp"

// A tetrahedron of 1 x 2 x 3 m whose corner has the map coordinates (498123.5, 5412345.25, 112). Doubles
// represent them exactly; single precision has steps of 0.5 m there.

namespace shelfbeam::test {
namespace {

const std::string far_block =
    "v 498123.5 5412345.25 112\nv 498124.5 5412345.25 112\nv 498123.5 5412347.25 112\nv 498123.5 5412345.25 "
    "115\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

Json store_at(const Json& at, const Json& more = Json::object()) {
  Json store = mesh_store("map.obj");
  store["fixtures"][0].update(more);
  store["fixtures"][0]["at"] = at;
  // The values of the sample are in metres.
  store["label_types"] = {{"small", {{"threshold", 0.02}}}};
  store["labels"] = {{{"id", "L"}, {"position", {0, 0, 0}}, {"normal", {0, 0, 1}}, {"type", "small"}}};
  store["transceiver_types"] = {{"down", {{"emission", {{"type", "lambertian"}, {"flux", 1}}}}}};
  return store;
}

Scene scene(const Json& store) {
  const TempFolder folder;
  folder.write("map.obj", far_block);
  return scene_of(store, folder.path());
}

void expect_at(const Scene& scene, const Vec3& low, const Vec3& size) {
  EXPECT_LT(length(scene.lower - low), 1e-8);
  EXPECT_LT(length(scene.upper - scene.lower - size), 1e-8);
  EXPECT_NEAR(mesh_area(scene), tetrahedron_area, 1e-7);
  EXPECT_TRUE(file_warnings(scene).empty());
}

TEST(MapCoordinates, AreBroughtBackByAt) {
  expect_at(scene(store_at({-498121, -5412343.75, -111})), {2.5, 1.5, 1}, {1, 2, 3});
  // A quarter turn takes (x, y) to (-y, x) before the shift.
  expect_at(scene(store_at({5412348, -498121, -111}, {{"rotation_deg", 90}})), {0.75, 2.5, 1}, {2, 1, 3});
}

TEST(MapCoordinates, MayBeInTheUnitOfTheStore) {
  Json store = store_at({-498121000, -5412343750, -111000});
  store["units"] = "mm";
  store["transceivers"]["list"][0]["position"] = {100, 100, 100};
  expect_at(scene(store), {2.5, 1.5, 1}, {1, 2, 3});
}

// The resolved store has the mesh near its origin, and gives the same scene.
TEST(MapCoordinates, AreResolved) {
  const TempFolder folder;
  folder.write("map.obj", far_block);
  const Json store = store_at({-498121, -5412343.75, -111});
  const Json resolved = Json::parse(expect_same_scene(read(store, folder.path())));
  EXPECT_EQ(resolved["fixtures"][0]["at"], Json({2.5, 1.5, 1.0}));
  EXPECT_EQ(resolved["fixtures"][0]["parts"][0]["vertices"][1], Json({0.0, 2.0, 0.0}));
}

TEST(MapCoordinates, ErrorGivesAnAtThatFits) {
  const std::string message = input_error([] { scene(store_at({0, 0, 0})); });
  EXPECT_NE(message.find("store.json: fixtures[0]: "), std::string::npos) << message;
  EXPECT_NE(message.find("map coordinates"), std::string::npos) << message;
  const std::size_t begin = message.find('['), end = message.find(']', message.find("'at'"));
  ASSERT_NE(begin, std::string::npos);
  const std::size_t from = message.rfind('[', end);
  const Json at = Json::parse(message.substr(from, end + 1 - from));
  expect_at(scene(store_at(at)), {0, 0, 0}, {1, 2, 3});
}

TEST(MapCoordinates, OtherErrorsKeepTheirMessages) {
  expect_input_error([] { scene(store_at({"x", 0, 0})); }, "fixtures[0].at");
  expect_input_error([] { scene(store_at({0, 0})); }, "fixtures[0].at");
  expect_input_error([] { scene(store_at({0, 0, 0}, {{"scale", 1e4}})); }, "extends 5.", "'scale'");
  Json near = store_at({20'000, 0, 0}, {{"scale", 1e-6}});
  expect_input_error([&] { scene(near); }, "fixtures[0].at[0]: is at 20000 m");
  const Json labels = {{{"id", "a"}, {"position", {0, 0, 0}}, {"normal", {0, 0, 1}}, {"type", "small"}}};
  expect_input_error([&] { scene(store_at({-498121, -5412343.75, -111}, {{"labels", labels}})); },
                     "fixtures[0].labels: ", "'labels' of the store");
}

}  // namespace
}  // namespace shelfbeam::test
