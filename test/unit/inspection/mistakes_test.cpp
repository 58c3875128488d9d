#include "unit/inspection/mistakes.hpp"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/inspection/plausibility.hpp"
#include "shelfbeam/scene/store/store.hpp"

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
    return make_inspected_scene(parse_store(store.dump(), "store.json", folder)).warnings;
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
  EXPECT_EQ(test::other_mistakes().size(), 18u);
  EXPECT_THAT(unnoticed(test::expected_mistakes()), testing::IsEmpty());
  EXPECT_THAT(unnoticed(test::other_mistakes()), testing::IsEmpty());
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

TEST(Mistakes, PlausibleChangesAreAccepted) {
  for (const Mistake& change : test::plausible_changes())
    for (const std::string& objection : objections(change)) ADD_FAILURE() << change.name << ": " << objection;
}

TEST(Mistakes, ExamplesHaveNone) {
  for (const char* name : {"thesis", "grocery", "chiller", "market-hall", "supermarket", "hypermarket"}) {
    const Scene scene = make_inspected_scene(
        read_store(fmt::format("{}/examples/{}/store.json", SHELFBEAM_SOURCE_DIR, name)));
    for (const std::string& warning : scene.warnings) ADD_FAILURE() << warning;
  }
}

}  // namespace
}  // namespace shelfbeam
