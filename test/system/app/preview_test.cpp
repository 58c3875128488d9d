#include <cmath>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;
using testing::HasSubstr;
using testing::Not;

class Preview : public test::ProgramTest {
 protected:
  Preview() { told("plan @store.json -o @plan --samples 2000 --no-certificate --quiet"); }

  std::string chosen() const { return Json::parse(bytes("plan/placement.json"))["selected"][0]; }
  // "x,y,z" from placement.csv.
  std::string place_of(const std::string& id) const {
    const std::string table = bytes("plan/placement.csv"), row = "\n" + id + ",";
    const std::size_t begin = table.find(row) + row.size();
    std::size_t end = begin;
    for (int k = 0; k < 3; ++k) end = table.find(',', end + 1);
    return table.substr(begin, end - begin);
  }
  Json previewed(const std::string& options) const {
    return Json::parse(told("preview @store.json " + options + " --json"));
  }
};

TEST_F(Preview, ShowsTheLabelsThatAUnitReaches) {
  const std::string text = told("preview @store.json --unit 2,1.5,2.9");
  EXPECT_THAT(text, HasSubstr("of 17 labels reached"));
  EXPECT_THAT(text, HasSubstr("weakest label"));
  EXPECT_EQ(told("preview @store.json --unit 2,1.5,2.9 --quiet"), "");
  const Json json = previewed("--unit 2,1.5,2.9 --unit 3,1.5,2.9,0,0.3,-1");
  EXPECT_EQ(json["simulated"], false);
  ASSERT_EQ(json["labels"].size(), 17U);
  EXPECT_EQ(json["added"].size(), 2U);
  for (const Json& label : json["labels"]) {
    EXPECT_GT(label["signal"], 0) << label;
    EXPECT_GT(label["error"], 0) << label;
    EXPECT_FALSE(label.contains("before"));
  }
}

// A candidate of the plan at its own place has the signals of the plan, within their errors. With previews of
// 17 labels at four errors, one run in a thousand would fail.
TEST_F(Preview, AgreesWithThePlan) {
  const std::string id = chosen();
  const std::string there = place_of(id), move = "--from @plan --move " + id + "," + there;
  for (const std::string how : {"", " --refine 0.5"}) {
    const Json json = previewed(move + how);
    EXPECT_EQ(json["simulated"], !how.empty());
    for (const Json& label : json["labels"]) {
      const double before = label["before"], signal = label["signal"], error = label["error"];
      EXPECT_NEAR(signal, before, 4 * error + 0.03 * before) << label;
    }
  }
  const Json removed = previewed("--from @plan --remove " + id);
  EXPECT_EQ(removed["simulated"], true);
  EXPECT_LT(removed["labels_reached"], previewed(move)["labels_reached"]) << "control";
}

TEST_F(Preview, KeepsTheLightOfTheShop) {
  const Json first = previewed("--from @plan --unit 2,1.5,2.9");
  const std::string kept = bytes("plan/light.operator");
  EXPECT_EQ(previewed("--from @plan --unit 2,1.5,2.9 --threads 1"), first);
  EXPECT_EQ(bytes("plan/light.operator"), kept);
  std::string damaged = kept;
  damaged[kept.size() / 2] ^= 1;
  folder.write("plan/light.operator", damaged);
  refused("preview @store.json --from @plan --unit 2,1.5,2.9", {"light.operator", "is corrupt"});
}

// Units are found by their places, whatever their ids, and a plan that survives a failure omits the
// strongest.
TEST_F(Preview, FollowsTheProblemOfThePlan) {
  told("plan @store.json -o @safe --samples 2000 --no-certificate --survive-failure --quiet");
  const Json json = previewed("--from @safe --remove " +
                              std::string(Json::parse(bytes("safe/placement.json"))["selected"][0]));
  EXPECT_EQ(json["survives_failure"], true);
  EXPECT_GT(json["labels_lost"], 0);
}

// The squares of such axes overflow or vanish.
TEST_F(Preview, TakesAnAxisOfAnyLength) {
  const auto signals = [&](const std::string& unit, const std::string& axis) {
    return previewed(unit + "2,1.5,2.9," + axis + " --coarse")["labels"];
  };
  for (const std::string& unit : {std::string("--unit "), "--from @plan --move " + chosen() + ","}) {
    const Json usual = signals(unit, "0,0.3,-1");
    EXPECT_EQ(signals(unit, "0,0.3e200,-1e200"), usual) << unit;
    EXPECT_EQ(signals(unit, "0,0.3e-170,-1e-170"), usual) << unit;
    EXPECT_NE(signals(unit, "0,1e200,-1e200"), usual) << "the control";
  }
}

TEST_F(Preview, RefusesWhatItCannotRead) {
  for (const auto& [options, part] : std::vector<std::pair<std::string, std::string>>{
           {"--unit 2,1.5", "2 numbers"},
           {"--unit 2,1.5,29", "outside the room"},
           {"--unit 2,1.5,2.9,0,0,0", "zero vector"},
           {"--unit 2,1.5,2.9,lamp", "unknown type"},
           {"--unit 2,1.5,2.9,ceiling,more", "more than a type"},
           {"", "selects no unit"},
           {"--from @plan", "has no unit"},
           {"--from @plan --remove nobody", "not among the mounted units"},
           {"--from @plan --move nobody,2,1.5,2.9", "the id of no unit"},
           {"--from @nowhere --unit 2,1.5,2.9", "nowhere"}})
    refused("preview @store.json " + options, {part});
}

// The units that the store selects are those of a plan that selects them.
TEST_F(Preview, ExaminesTheUnitsThatTheStoreSelects) {
  Json store = json("store.json");
  store["transceivers"]["selected"] = Json::parse(bytes("plan/placement.json"))["selected"];
  folder.write("chosen.json", store.dump());
  const auto of_chosen = [&](const std::string& options) {
    return Json::parse(told("preview @chosen.json " + options + " --json"));
  };
  const Json alone = of_chosen("");
  EXPECT_EQ(alone["simulated"], false);
  EXPECT_EQ(alone["labels_gained"], 0);
  EXPECT_THAT(told("preview @chosen.json"), Not(HasSubstr("gained")));
  const std::string id = chosen();
  const Json without = of_chosen("--remove " + id);
  EXPECT_LT(without["labels"][0]["signal"], alone["labels"][0]["signal"]);
  EXPECT_EQ(without["labels"][0]["before"], alone["labels"][0]["signal"]);
  const Json refined = of_chosen("--refine 0.2"), of_plan = previewed("--from @plan --remove " + id);
  EXPECT_EQ(refined["simulated"], true);
  // Signals of the plan have errors, too; as above.
  for (std::size_t i = 0; i < refined["labels"].size(); ++i) {
    const double signal = refined["labels"][i]["signal"], before = of_plan["labels"][i]["before"],
                 error = refined["labels"][i]["error"];
    EXPECT_NEAR(signal, before, 4 * error + 0.03 * before);
  }
  EXPECT_THAT(told("verify @chosen.json"), HasSubstr("reach all 17 labels"));
  refused("verify @store.json", {"selects no transceivers"});
}

}  // namespace
}  // namespace shelfbeam
