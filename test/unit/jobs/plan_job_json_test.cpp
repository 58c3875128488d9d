#include "jobs/plan_job_json.hpp"

#include <nlohmann/json.hpp>

#include "support/testing.hpp"

namespace shelfbeam::jobs {
namespace {

PlanJob job_with_all_values() {
  PlanJob job;
  job.store = "shop/store.json";
  job.folder = "plans/\xff";  // not UTF-8
  job.signal = "signal.h5";
  job.selection = "placement.json";
  job.model = CommunicationModel::non_cooperative;
  job.units = {{"G1-1-1", "till*"}, {"G1-?-2"}};
  job.without = {Cause::people, Cause::reflectance};
  job.sampled = {"one.h5", "two.h5"};
  job.threads = 3;
  job.checkpoint.resume = true;
  job.checkpoint.interval_s = 0;
  job.allow_outside = job.strict = job.overwrite = job.safe_csv = true;
  job.reports_progress = false;
  PlanRequest& plan = job.plan;
  plan.seed = ~std::uint64_t{0};
  plan.simulation.estimator = EstimatorKind::uniform;
  plan.simulation.direct = DirectLight::sampled;
  plan.simulation.samples = 6400;
  plan.simulation.relative_error = 0.05;
  plan.simulation.above = 0.2;
  plan.simulation.max_samples = 4000;
  plan.simulation.time_s = 1.5;
  plan.simulation.strategy = Strategy::nee;
  plan.simulation.heuristic = Heuristic::power;
  plan.simulation.max_bounces = 4;
  plan.simulation.memory = 1'000'000;
  plan.problem = {CommunicationModel::non_cooperative, Objective::links, Combination::weighted, 0.5, true};
  plan.partial.at_most = 4;
  plan.partial.share = 0.9;
  plan.place.solver = SolverChoice::mip;
  plan.place.backend = "cbc";
  plan.place.time_limit_s = 7;
  plan.constraints = {{"costs.csv"}, 2.5, {"forbidden.csv"}};
  plan.certifies = plan.alternatives = false;
  plan.confidence = 0.95;
  plan.budget_s = 30;
  plan.curve = true;
  plan.reflectance_error = 0.2;
  plan.states = 0;
  plan.goal = {AvailabilityRule::misses, 0.5};
  return job;
}

TEST(PlanJobJson, IsReadBack) {
  const PlanJob job = job_with_all_values();
  const std::string text = to_json(job);
  const PlanJob read = parse_plan_job(text, "job");
  EXPECT_EQ(to_json(read), text);
  EXPECT_EQ(read.folder, job.folder);
  EXPECT_EQ(read.plan.seed, job.plan.seed);
  EXPECT_EQ(read.plan.problem.combination, Combination::weighted);
  EXPECT_EQ(read.plan.states, 0U);
  ASSERT_TRUE(read.plan.simulation.heuristic);
  EXPECT_EQ(*read.plan.simulation.heuristic, Heuristic::power);
  // Every value counts: each of them is written.
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(json.size(), 18U);
  EXPECT_EQ(json["plan"].size(), 15U);
  EXPECT_EQ(json["plan"]["simulation"].size(), 11U);
}

TEST(PlanJobJson, OmitsDefaults) {
  PlanJob job;
  job.store = "store.json";
  job.folder = "plan";
  EXPECT_EQ(nlohmann::ordered_json::parse(to_json(job)),
            nlohmann::ordered_json::parse(R"({"store": "store.json", "folder": "plan", "plan":
              {"simulation": {}, "problem": {}, "place": {}, "constraints": {}}})"));
  EXPECT_EQ(to_json(parse_plan_job(R"({"store": "store.json", "folder": "plan"})", "job")), to_json(job));
}

TEST(PlanJobJson, NamesTheKeyOfAnError) {
  const auto expect = [](const std::string& text, std::string_view place, std::string_view problem) {
    test::expect_input_error([&] { parse_plan_job(text, "job"); }, place, problem);
  };
  expect("[]", "job", "object");
  expect(R"({"folder": "plan"})", "job", "store");
  expect(R"({"store": "s", "folder": "f", "thread": 1})", "thread", "threads");
  expect(R"({"store": "s", "folder": "f", "plan": {"confidence": 2}})", "plan.confidence", "2");
  expect(R"({"store": "s", "folder": "f", "plan": {"seed": -1}})", "plan.seed", "whole number");
  expect(R"({"store": "s", "folder": "f", "plan": {"simulation": {"estimator": "none"}}})",
         "plan.simulation.estimator", "none");
}

}  // namespace
}  // namespace shelfbeam::jobs
