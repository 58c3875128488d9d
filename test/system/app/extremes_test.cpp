// Tests extreme problems: one of everything, no label reached, all labels reached, equal candidates, very
// many labels.

#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::Json;

// A room of 8 x 6 x 3 m with one candidate and one label.
Json smallest_store(double threshold, double reflectance = 0.3) {
  Json store = test::small_store();
  store["fixtures"] = Json::array();
  store["materials"]["m"]["reflectance"] = reflectance;
  store["label_types"]["standard"]["threshold"] = threshold;
  store["transceivers"] =
      Json::parse(R"({ "list": [ { "id": "T", "position": [4, 3, 2.9], "type": "ceiling" } ] })");
  return store;
}

class Extremes : public test::ProgramTest {
 protected:
  Json planned(const Json& store, int exit_code, const std::string& options = "", int samples = 640) {
    folder.write("store.json", store.dump());
    told(fmt::format("plan @store.json -o @plan --samples {} --overwrite {}", samples, options), exit_code);
    return json("plan/placement.json");
  }
  Json placed(const std::string& options, int exit_code) {
    told("place @matrix.csv -o @placement.json --threshold " + options, exit_code);
    return json("placement.json");
  }
};

TEST_F(Extremes, OneLabelAndOneCandidate) {
  const Json answer = planned(smallest_store(0.001), 0);
  EXPECT_EQ(answer["status"], "optimal");
  EXPECT_EQ(answer["selected"], Json::parse(R"(["T"])"));
  EXPECT_EQ(answer["count_lower_bound"], 1);
}

TEST_F(Extremes, NoLabelIsReached) {
  Json store = smallest_store(1e-12, 0);
  store["labels"][0]["normal"] = {-1, 0, 0};  // no light at all
  const Json dark = planned(store, 1);
  EXPECT_EQ(dark["status"], "infeasible");
  ASSERT_EQ(dark["unreachable"].size(), 1u);
  EXPECT_EQ(dark["unreachable"][0]["most"], 0.0);
  const Json weak = planned(smallest_store(1e9), 1);
  EXPECT_EQ(weak["status"], "infeasible");
  EXPECT_GT(weak["unreachable"][0]["most"], 0.0);
}

TEST_F(Extremes, EveryUnitReachesEveryLabel) {
  Json store = test::small_store();
  store["label_types"]["standard"]["threshold"] = 1e-12;
  for (const char* model : {"cooperative", "non-cooperative"}) {
    const Json answer = planned(store, 0, std::string("--model ") + model);
    EXPECT_EQ(answer["status"], "optimal") << model;
    EXPECT_EQ(answer["count"], 1) << model;
    EXPECT_EQ(answer["count_lower_bound"], 1) << model;
  }
}

// Twelve columns of 0.01: the count is the smallest whose sum meets the requirement, even if the sum is equal
// to it, which 4 x 0.01 in single precision is not.
TEST_F(Extremes, AllCandidatesAreAlike) {
  std::string row = "0.01";
  for (int j = 1; j < 12; ++j) row += ",0.01";
  folder.write("matrix.csv", fmt::format("{0}\n{0}\n{0}\n", row));
  for (const auto& [threshold, count] : std::vector<std::pair<std::string, int>>{
           {"0.005", 1}, {"0.01", 1}, {"0.035", 4}, {"0.04", 4}, {"0.0401", 5}, {"0.12", 12}}) {
    const Json answer = placed(threshold, 0);
    EXPECT_EQ(answer["status"], "optimal") << threshold;
    EXPECT_EQ(answer["count"], count) << threshold;
    EXPECT_EQ(answer["count_lower_bound"], count) << threshold;
  }
  EXPECT_EQ(placed("0.1201", 1)["status"], "infeasible");
  EXPECT_EQ(placed("0.01 --model non-cooperative", 0)["count"], 1);
  EXPECT_EQ(placed("0.0101 --model non-cooperative", 1)["status"], "infeasible");
}

// A floor of 400 x 250 labels below four units: the matrix is complete, and every label has a result.
TEST_F(Extremes, SlowAHundredThousandLabels) {
  Json store = smallest_store(1e-6);
  store["room"]["size"] = {100, 80, 4};
  store["labels"] = Json::array();
  for (int i = 0; i < 100000; ++i) {
    const int row = i / 400;
    store["labels"].push_back({{"id", fmt::format("L{}", i)},
                               {"position", {0.1 + 0.25 * (i % 400), 0.1 + 0.3 * row, 1.2}},
                               {"normal", {0, 0, 1}},
                               {"type", "standard"}});
  }
  store["transceivers"] = Json::parse(
      R"({ "grids": [ { "type": "ceiling", "min": [25, 20], "max": [75, 60], "spacing": 25, "z": 3.9 } ] })");
  const Json answer = planned(store, 0, "--estimator uniform --max-bounces 1 --no-certificate", 64);
  EXPECT_EQ(answer["labels"], 100000);
  EXPECT_TRUE(answer["unreachable"].empty());
  EXPECT_EQ(answer["status"], "optimal");
}

}  // namespace
}  // namespace shelfbeam
