#include "serve/project/starter.hpp"

#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/scene/store/completed_fixture.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

using Json = nlohmann::ordered_json;
using testing::IsEmpty;

const std::string catalogue_text = read_file(SHELFBEAM_SOURCE_DIR "/data/catalogue.json");

// A new project, whose shop gets fixtures.
class NewShop {
 public:
  NewShop() {
    start_project(folder_.path());
    store_ = parse_json(read_file(folder_ / "store.json"), "store.json");
    catalogue_ = parse_json(catalogue_text, "catalogue.json");
  }

  const Json& presets() const { return catalogue_["presets"]; }

  // A fixture with all keys of its preset.
  Json completed(const std::string& preset) const {
    const Json store = with(Json::array({{{"preset", preset}}}));
    return completed_fixture(JsonCursor::parse(store.dump(), "store.json"), folder_.path(), 0).whole.json;
  }

  Scene scene(const Json& fixtures) const {
    return make_inspected_scene(parse_store(with(fixtures).dump(), "store.json", folder_.path()));
  }

 private:
  Json with(const Json& fixtures) const {
    Json store = store_;
    store["fixtures"] = fixtures;
    return store;
  }

  TempFolder folder_;
  Json store_, catalogue_;
};

Json placed(const std::string& preset, bool is_box) {
  Json fixture{{"preset", preset}, {"id", "A"}, {"at", {8, 6}}};
  if (is_box) fixture["at"].push_back(0);
  return fixture;
}

TEST(Starter, FillsFoldersWithoutProject) {
  const TempFolder parent;
  const fs::path folder = parent / "new/shop";
  const auto expect_shop = [&] {
    start_project(folder);
    EXPECT_EQ(read_file(folder / "catalogue.json"), catalogue_text);
    EXPECT_EQ(parse_json(read_file(folder / "store.json"), "store.json")["name"], "New shop");
  };
  expect_shop();
  fs::remove(folder / "store.json");  // as after a run that was killed
  fs::create_directory(folder / ".shelfbeam");
  expect_shop();
  write_file(folder / "store.json", "{}");
  start_project(folder);
  EXPECT_EQ(read_file(folder / "store.json"), "{}");
}

TEST(Starter, LeavesOtherFoldersAlone) {
  for (const char* name : {"catalogue.json", "plan.png", ".shelfbeam/history.jsonl"}) {
    const TempFolder folder;
    folder.write(name, "mine");
    start_project(folder.path());
    EXPECT_FALSE(fs::exists(folder / "store.json")) << name;
    EXPECT_EQ(read_file(folder / name), "mine");
    EXPECT_EQ(folder.count(), 1) << name;
  }
}

TEST(StarterCatalogue, HasUsableFixtures) {
  const NewShop shop;
  EXPECT_GE(shop.presets().size(), 25U);
  for (const auto& [name, keys] : shop.presets().items()) {
    const Json whole = shop.completed(name);
    const bool is_box = whole["type"] == "box", has_labels = whole.contains("labels");
    EXPECT_NE(has_labels, name == "check-out 1.80 m") << name;
    Json fixtures = Json::array({placed(name, is_box)});
    if (!has_labels) {  // a store needs some
      fixtures.push_back(placed("gondola 1.25 m, double, 1.6 m high", false));
      fixtures[1].update({{"id", "B"}, {"at", {2, 2}}});
    }
    const Scene alone = shop.scene(fixtures);
    EXPECT_GT(alone.labels.size(), 0U) << name;
    EXPECT_THAT(sentences(alone.warnings), IsEmpty()) << name;

    const double length = is_box ? whole["size"][0] : whole["length"];
    EXPECT_TRUE(name.find(fmt::format(" {:.2f} m", length)) != std::string::npos ||
                name.find(" 4 ft") != std::string::npos)
        << name;
    fixtures[0].update({{"id", "A{n}"}, {"repeat", {{"count", 3}, {"step", length}}}});
    EXPECT_THAT(sentences(shop.scene(fixtures).warnings), IsEmpty()) << name << ", a row";

    if (whole["type"] != "box" && whole["labels"].value("faces", whole.value("faces", Json())).size() == 1) {
      fixtures[0].erase("at");
      fixtures[0]["against"] = {{"wall", 2}, {"from", 3}};
      EXPECT_THAT(sentences(shop.scene(fixtures).warnings), IsEmpty()) << name << ", at a wall";
    }
  }
}

PlanOptions options() {
  PlanOptions options;
  options.simulation.samples = decision_samples;
  options.place.step_limit = 1 << 20;
  options.budget.samples = 20'000'000;
  return options;
}

TEST(StarterCatalogueSlow, GondolaIsPlanned) {
  const NewShop shop;
  const Json gondola = placed("gondola 1.25 m, double, 1.6 m high", false);
  const Plan plan = make_plan(shop.scene(Json::array({gondola})), options());
  ASSERT_TRUE(plan.certificate);
  EXPECT_TRUE(plan.certificate->all_reached());
}

TEST(StarterCatalogueSlow, AllLabelsCanBeReached) {
  const NewShop shop;
  PlanOptions uncertified = options();
  uncertified.confidence.reset();
  for (const auto& [name, keys] : shop.presets().items()) {
    const Json whole = shop.completed(name);
    if (!whole.contains("labels")) continue;
    const Scene scene = shop.scene(Json::array({placed(name, whole["type"] == "box")}));
    EXPECT_TRUE(make_plan(scene, uncertified).placement.has_selection()) << name;
  }
}

}  // namespace
}  // namespace shelfbeam::serve
