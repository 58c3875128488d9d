#include "shelfbeam/scene/build/draft.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/json.hpp"
#include "shelfbeam/scene/mesh/read_cache.hpp"

#include "support/testing.hpp"
#include "unit/scene/mistakes.hpp"
#include "unit/scene/sample_store.hpp"

namespace shelfbeam::test {
namespace {

namespace fs = std::filesystem;

const fs::path photometry = SHELFBEAM_SOURCE_DIR "/data/photometry";

Draft draft_of(const Json& store, SceneDetail detail = SceneDetail::outlines) {
  return read_draft(JsonCursor::parse(store.dump(), "store.json"), photometry, detail);
}

void expect_same_plan(const Scene& drawn, const Scene& whole) {
  ASSERT_EQ(ids_of(drawn.fixtures), ids_of(whole.fixtures));
  for (std::size_t f = 0; f < whole.fixtures.size(); ++f) {
    const FixtureOutline &one = drawn.fixtures[f], &other = whole.fixtures[f];
    EXPECT_EQ(std::tie(one.type, one.footprint, one.height, one.rotation_deg, one.form),
              std::tie(other.type, other.footprint, other.height, other.rotation_deg, other.form));
  }
  const auto expect_same = [](const auto& devices, const auto& others) {
    ASSERT_EQ(devices.size(), others.size());
    for (std::size_t k = 0; k < devices.size(); ++k) {
      EXPECT_EQ(devices[k].id, others[k].id);
      EXPECT_EQ(devices[k].position, others[k].position);
      EXPECT_EQ(devices[k].type, others[k].type);
    }
  };
  expect_same(drawn.labels, whole.labels);
  expect_same(drawn.transceivers, whole.transceivers);
  expect_same(drawn.excluded, whole.excluded);
  EXPECT_EQ(drawn.lower, whole.lower);
}

TEST(Draft, HasThePlanOfTheCompleteScene) {
  ReadCache cache;
  for (const char* name : {"thesis", "grocery", "chiller", "market-hall", "supermarket", "chiller"}) {
    SCOPED_TRACE(name);
    const fs::path file = fs::path(SHELFBEAM_SOURCE_DIR "/examples") / name / "store.json";
    DeviceSources sources;
    const Scene whole = make_scene(read_store(file), &sources);
    const Draft draft = read_draft(JsonCursor::parse_file(file), file.parent_path(), SceneDetail::outlines,
                                   {.cache = &cache});
    EXPECT_TRUE(draft.problems.empty());
    expect_same_plan(draft.scene, whole);
    EXPECT_EQ(draft.sources.fixtures, sources.fixtures);
    EXPECT_EQ(draft.sources.labels, sources.labels);
    EXPECT_EQ(draft.sources.transceivers, sources.transceivers);
    EXPECT_LT(draft.scene.mesh.triangles.size(), whole.mesh.triangles.size());
  }
}

TEST(Draft, HasTheSurfacesOfTheCompleteScene) {
  const Draft draft = draft_of(sample_store(), SceneDetail::surfaces);
  const Scene whole = make_scene(parse_store(sample_store().dump(), "store.json", photometry));
  expect_same_plan(draft.scene, whole);
  EXPECT_EQ(draft.scene.mesh.triangles, whole.mesh.triangles);
  EXPECT_EQ(draft.scene.mesh.vertices, whole.mesh.vertices);
}

// Whether make_scene accepts a store, and the path of the problem otherwise, is known from its draft.
TEST(Draft, HasProblemsIfTheStoreIsRefused) {
  for (const Json& mistake : mistakes()) {
    SCOPED_TRACE(mistake);
    Json store = sample_store();
    store[Json::json_pointer(mistake[0].get<std::string>())] = mistake[1];
    const Draft draft = draft_of(store);
    ASSERT_FALSE(draft.problems.empty());
    EXPECT_EQ(draft.problems.front().path, mistake[2]);
    EXPECT_THROW(make_scene(parse_store(store.dump(), "store.json", photometry)), InputError);
  }
}

// Problems that are found only when the scene is made.
TEST(Draft, HasAllProblemsOfPositionsAndIds) {
  Json store = sample_store();
  store["labels"].push_back(store["labels"][0]);
  store["labels"].push_back(store["labels"][0]);
  store["labels"].back()["id"] = "far";
  store["labels"].back()["position"] = {100, 1, 1};
  store["fixtures"].push_back(store["fixtures"][0]);
  store["transceivers"]["pinned"] = {"nobody"};
  std::vector<std::string> paths;
  const Draft draft = draft_of(store);
  for (const Finding& problem : draft.problems) paths.push_back(problem.path);
  EXPECT_THAT(paths, testing::UnorderedElementsAre("fixtures[4]", "labels[1]", "labels[2]",
                                                   testing::HasSubstr("transceivers.pinned")));
  EXPECT_EQ(draft.scene.labels.size(), draft_of(sample_store()).scene.labels.size() + 2);
}

TEST(Draft, DrawsTheRest) {
  Json store = sample_store();
  ASSERT_EQ(ids_of(draft_of(store).scene.fixtures), "A F C M ");
  store["fixtures"][1]["material"] = "sugar";
  Draft draft = draft_of(store);
  EXPECT_EQ(ids_of(draft.scene.fixtures), "A C M F ") << "its size is known";
  EXPECT_EQ(draft.scene.fixtures.size(), draft.sources.fixtures.size());
  EXPECT_EQ(draft.sources.fixtures.back(), "store.json: fixtures[1]");
  for (const Label& label : draft.scene.labels) EXPECT_FALSE(label.id.starts_with("F-"));
  store["fixtures"][1].erase("depth");
  EXPECT_EQ(ids_of(draft_of(store).scene.fixtures), "A C M ");
  store = {{"fixtures", Json::array()}};
  draft = draft_of(store);
  EXPECT_TRUE(draft.scene.fixtures.empty());
  EXPECT_FALSE(draft.problems.empty());
}

}  // namespace
}  // namespace shelfbeam::test
