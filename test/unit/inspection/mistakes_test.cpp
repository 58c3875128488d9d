#include "unit/inspection/mistakes.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/error.hpp"
#include "shelfbeam/inspection/checks.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "support/small_store.hpp"
#include "support/temp_folder.hpp"

// Stores with one mistake each. A planner must hear of it before any simulation.

namespace shelfbeam {
namespace {

using test::Mistake;

// The warnings about a store, or the error that refuses it.
std::vector<std::string> objections(const Mistake& mistake) {
  test::Json store = test::good_store();
  mistake.make(store);
  try {
    const std::string folder = SHELFBEAM_SOURCE_DIR "/examples/chiller";
    return sentences(make_inspected_scene(parse_store(store.dump(), "store.json", folder)).warnings);
  } catch (const InputError& refused) {
    return {refused.what()};
  }
}

std::vector<std::string> unnoticed(const std::vector<Mistake>& mistakes) {
  std::vector<std::string> names;
  for (const Mistake& mistake : mistakes)
    if (objections(mistake).empty()) names.push_back(mistake.name);
  return names;
}

TEST(Mistakes, AreNoticed) {
  EXPECT_EQ(test::expected_mistakes().size(), 38u);
  EXPECT_EQ(test::other_mistakes().size(), 19u);
  EXPECT_THAT(unnoticed(test::expected_mistakes()), testing::IsEmpty());
  EXPECT_THAT(unnoticed(test::other_mistakes()), testing::IsEmpty());
}

TEST(Mistakes, ReceiversOfAMeasuringPlaneAreInMidAir) {
  Mistake plane{"", [](test::Json& store) {
                  store["measuring_planes"] = test::Json::parse(R"([{"id": "P", "type": "standard",
                    "origin": [6, 2, 1.2], "axes": [[1, 0, 0], [0, 1, 0]], "size": [0.4, 0.4], "counts": [1, 1]}])");
                  store["measuring_planes"][0]["type"] = store["label_types"].begin().key();
                }};
  EXPECT_THAT(objections(plane), testing::IsEmpty());
  const Mistake label{"", [&](test::Json& store) {
                        plane.make(store);
                        store.erase("measuring_planes");
                        store["labels"][0]["position"] = {6.2, 2.2, 1.2};
                        store["labels"][0]["normal"] = {0, 0, 1};
                      }};
  EXPECT_THAT(objections(label), testing::Not(testing::IsEmpty())) << "negative control: a label there";
}

TEST(Mistakes, OfLabelsNameTheArticleBeforeTheId) {
  for (const auto& [name, sentence] :
       {std::pair("a label in mid-air", "label 'Rye bread' \\(.*\\) at .* has no surface"),
        std::pair("a label in a closed store room", "label 'Rye bread' \\(inside\\) at .* is separated from"),
        std::pair("two labels at one place",
                  "label 'Rye bread' \\(copy\\) .* mm from label 'Rye bread' \\(")})
    for (const Mistake& mistake : test::expected_mistakes()) {
      if (mistake.name != name) continue;
      const Mistake described{name, [&](test::Json& store) {
                                mistake.make(store);
                                for (test::Json& label : store["labels"]) label["description"] = "Rye bread";
                              }};
      EXPECT_THAT(objections(described), testing::Contains(testing::ContainsRegex(sentence))) << name;
    }
}

// The error of a list outside the room names the probable mistake.
TEST(Mistakes, OfWholeListsAreNamed) {
  for (const auto& [name, cause] : {std::pair("labels with x and y exchanged", "x and y look exchanged"),
                                    std::pair("labels with y and z exchanged", "y and z look exchanged"),
                                    std::pair("labels in feet", "look like feet"),
                                    std::pair("labels in centimetres", "look like centimetres")})
    for (const Mistake& mistake : test::expected_mistakes()) {
      if (mistake.name != name) continue;
      EXPECT_THAT(objections(mistake), testing::ElementsAre(testing::HasSubstr(cause))) << name;
    }
}

TEST(Mistakes, SpacingsOfAllGeneratedCandidatesAreChecked) {
  const auto areas = [](double spacing) {
    return test::Json{{"areas", {{{"type", "spot"}, {"area", "room"}, {"spacing", spacing}, {"z", 2.9}}}}};
  };
  const auto rails = [](double spacing) {
    return test::Json{
        {"rails",
         {{{"type", "spot"}, {"id", "R"}, {"points", {{1, 3, 2.9}, {4, 3, 2.9}}}, {"spacing", spacing}}}}};
  };
  const auto of = [](const test::Json& transceivers) {
    return objections({"", [&](test::Json& store) { store["transceivers"] = transceivers; }});
  };
  using testing::Contains, testing::HasSubstr;
  EXPECT_THAT(of(areas(0.2)),
              Contains(HasSubstr("transceivers.areas[0].spacing: is 0.2 m; 0.5 to 3 m are typical")));
  EXPECT_THAT(of(areas(9)),
              Contains(HasSubstr("transceivers.areas[0].spacing: is 9 m; 0.5 to 3 m are typical")));
  EXPECT_THAT(of(rails(0.2)), Contains(HasSubstr("transceivers.rails[0].spacing: is 0.2 m")));
  EXPECT_THAT(of(rails(9)), Contains(HasSubstr("transceivers.rails[0].spacing: is 9 m")));
  EXPECT_THAT(of(areas(1)), testing::Not(Contains(HasSubstr("spacing"))));
}

TEST(Mistakes, PlausibleChangesAreAccepted) {
  for (const Mistake& change : test::plausible_changes())
    for (const std::string& objection : objections(change)) ADD_FAILURE() << change.name << ": " << objection;
}

TEST(Mistakes, UnusedPartsOfCataloguesAreNone) {
  const test::TempFolder folder;
  const test::Json more = test::Json::parse(R"({
    "materials": { "wood": { "type": "lambertian", "reflectance": 0.5 } },
    "label_types": { "old": { "threshold": 0.02 } },
    "transceiver_types": { "old": { "emission": { "type": "lambertian", "flux": 1 } } } })");
  folder.write("chain.json", more.dump());
  const auto warnings = [&](const test::Json& store) {
    return sentences(make_inspected_scene(parse_store(store.dump(), "store.json", folder.path())).warnings);
  };
  test::SmallStore small;
  small.labels.clear();
  test::Json store = test::Json::parse(small.text());
  EXPECT_THAT(warnings(store), testing::IsEmpty());
  test::Json shared = store;
  shared["catalogues"] = {"chain.json"};
  EXPECT_THAT(warnings(shared), testing::IsEmpty());
  for (const auto& [section, parts] : more.items()) store[section].update(parts);
  EXPECT_THAT(warnings(store), testing::SizeIs(3));
}

TEST(Mistakes, ChecksCanBeCancelled) {
  CancelToken token;
  const std::string folder = SHELFBEAM_SOURCE_DIR "/examples/chiller";
  Store store = parse_store(test::good_store().dump(), "store.json", folder);
  store.cancel = &token;
  const Scene scene = make_scene(store);
  const DeviceSources sources{std::vector<std::string>(scene.fixtures.size()),
                              std::vector<std::string>(scene.labels.size()),
                              std::vector<std::string>(scene.transceivers.size()),
                              {}};
  const Inspected inspected(store, scene, sources);
  token.request();
  WarningList warnings(store.file, store.ignored);
  EXPECT_THROW(warn_of_fixtures(inspected, warnings), Interrupted);
  EXPECT_THROW(warn_of_labels(inspected, warnings), Interrupted);
  EXPECT_THROW(warn_of_units(inspected, warnings), Interrupted);
  EXPECT_THROW(warn_of_separated(inspected, warnings), Interrupted);
}

TEST(Mistakes, ExamplesHaveNone) {
  for (const char* name : {"thesis", "grocery", "chiller", "market-hall", "supermarket", "hypermarket"}) {
    const Scene scene = make_inspected_scene(
        read_store(fmt::format("{}/examples/{}/store.json", SHELFBEAM_SOURCE_DIR, name)));
    for (const std::string& warning : sentences(scene.warnings)) ADD_FAILURE() << warning;
  }
}

}  // namespace
}  // namespace shelfbeam
