#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

// Questions that leave some labels missed: max coverage, the fewest units for a share of the labels, and the
// coverage curve, with and without weights.

namespace shelfbeam {
namespace {

using test::Json;

class Coverage : public test::ProgramTest {
 protected:
  Coverage() {
    folder.write("m.csv", "label,A,B,C\nL1,1,0,1\nL2,1,0,1\nL3,1,0,0\nL4,0,1,1\nL5,0,1,1\nL6,0,1,0\n");
    folder.write("weights.csv", "id,weight\nL3,5\nL6,0.5\n");
    folder.write("ones.csv", "id,weight\nL3,1\nL6,1.0\n");
  }

  /// The result, without the steps and the wall time.
  Json answer(const std::string& options, int exit_code = 0) {
    Json json = Json::parse(told("place @m.csv --threshold 1 --json " + options, exit_code));
    for (const char* key : {"steps", "seconds"}) json.erase(key);
    return json;
  }
};

TEST_F(Coverage, IsDescribed) {
  const auto expect = [&](const std::string& options, const std::vector<std::string>& parts,
                          int exit_code = 0) {
    const std::string text = told("place @m.csv --threshold 1 " + options, exit_code);
    for (const std::string& part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << options << '\n' << part << '\n' << text;
  };
  expect(
      "--at-most 1 --weights @weights.csv",
      {"1 transceiver reaches 3 of 6 labels, 73.7 % of the weight (cooperative); it is proven that no single "
       "transceiver reaches more.\n  chosen: A\n  optimal: reached weight 7 of 9.5, upper bound 7, gap 0.0 "
       "%"});
  expect(
      "--reach 60%",
      {"1 transceiver reaches 4 of 6 labels, 66.7 % (cooperative); 60 % are required, and it is proven that "
       "fewer are not enough.\n  chosen: C\n  optimal: count 1, lower bound 1; "});
  expect("--reach 0.7", {"2 transceivers reach", "70 % are required, and it is proven that 1 is not enough"});
  expect("--reach 80 --weights @weights.csv", {"2 transceivers reach", "80 % are required"});
  expect(
      "--reach 1 --survive-failure",
      {"No selection reaches 100 % of the 6 labels (cooperative, even if any one unit fails); it is proven "
       "that none reaches more than 66.7 %.\n  infeasible; "},
      1);
  expect("--curve --weights @weights.csv", {"  units   weight reached: at least   at most\n",
                                            "      1                     73.6 %    73.7 %\n"});
}

TEST_F(Coverage, IsWritten) {
  const Json weighed = answer("--at-most 1 --weights @weights.csv -o @reach.json");
  EXPECT_EQ(weighed["reached_weight"], 7);
  EXPECT_EQ(weighed["weight_upper_bound"], 7);
  EXPECT_EQ(weighed["total_weight"], 9.5);
  EXPECT_EQ(weighed["missed"], (Json{"L4", "L5", "L6"}));
  EXPECT_EQ(json("reach.json")["missed"], weighed["missed"]);
  const Json curve = answer("--curve --weights @weights.csv");
  EXPECT_EQ(curve["total_weight"], 9.5);
  EXPECT_EQ(curve["curve"][0]["weight_at_least"], 7);
  EXPECT_EQ(curve["curve"][0]["weight_at_most"], 7);
  EXPECT_EQ(curve["curve"][1]["at_most"], 6);
  const Json fewest = answer("--reach 60%");
  EXPECT_EQ(fewest["target"], 4);
  EXPECT_EQ(fewest["count"], 1);
  EXPECT_EQ(fewest["count_lower_bound"], 1);
  EXPECT_EQ(answer("--reach 60% --weights @weights.csv")["reached_weight"], 7);
  const Json none = answer("--reach 100% --survive-failure", 1);
  EXPECT_EQ(none["status"], "infeasible");
  EXPECT_TRUE(none["count"].is_null() && none["count_lower_bound"].is_null());
  EXPECT_EQ(none["reachable"], 4);
}

// Weights of 1 are no weights.
TEST_F(Coverage, IsTheSameWithWeightsOfOne) {
  for (const std::string options : {"--at-most 1", "--curve", "--reach 70%"})
    EXPECT_EQ(answer(options + " --weights @ones.csv"), answer(options)) << options;
}

// Linear programming bounds leave some thirty labels open.
TEST_F(Coverage, OfTwoUnitsIsProvenInTheThesisStore) {
  const std::string store = SHELFBEAM_SOURCE_DIR "/examples/thesis/store.json";
  told("simulate " + store + " -o @signal.h5 --estimator uniform --samples 64 --quiet");
  const auto ask = [&](const std::string& solver) {
    return Json::parse(told("place @signal.h5 --threshold 0.03 --at-most 2 --json --solver " + solver));
  };
  const Json two = ask("search"), greedy = ask("greedy");
  EXPECT_EQ(two["status"], "optimal");
  EXPECT_EQ(two["bound_proof"], "log");
  EXPECT_EQ(two["solver"], "search");
  EXPECT_EQ(two["reached"], two["reached_upper_bound"]);
  EXPECT_GE(two["reached"], greedy["reached"]);
  EXPECT_LT(two["reached"], greedy["reached_upper_bound"]);
}

// Where the limit comes before a proof, the bounds are reported.
TEST_F(Coverage, StopsWithBounds) {
  std::string rows = "label";
  for (int j = 0; j < 60; ++j) rows += ",T" + std::to_string(j);
  for (int i = 0; i < 120; ++i) {
    rows += "\nL" + std::to_string(i);
    for (int j = 0; j < 60; ++j) rows += "," + std::to_string((i * 7919 + j * 104729 + i * j * 31) % 97);
  }
  folder.write("m.csv", rows + "\n");
  const Json stopped =
      Json::parse(told("place @m.csv --threshold 400 --reach 90% --time-limit 0.3 --json", 3));
  EXPECT_EQ(stopped["status"], "stopped");
  EXPECT_LT(stopped["count_lower_bound"], stopped["count"]);
}

}  // namespace
}  // namespace shelfbeam
