#include "serve/planning/plan_runs.hpp"

#include "unit/plan/plan_store.hpp"
#include "unit/serve/testing.hpp"

namespace shelfbeam::serve {
namespace {

const Json quick_plan{{"seed", 3}, {"budget", 20}};

class PlanRunsOfAShop : public testing::Test {
 protected:
  PlanRunsOfAShop() {
    folder_.write("store.json", PlanStore().text());
    fs::create_directory(folder_ / ".shelfbeam");
  }

  void open() { runs_.emplace(folder_.path(), SHELFBEAM_BINARY); }
  const PlanRun& run(std::uint64_t id) const { return *runs_->find(id); }
  bool wait(const std::function<bool()>& is) {
    return becomes_true([&] {
      runs_->poll([this]() -> const std::string& { return shop_; });
      return is();
    });
  }
  bool wait_for_end(std::uint64_t id) {
    return wait([&] { return !run(id).is_active(); });
  }
  static Json plan_of(std::uint64_t samples) {
    Json plan = quick_plan;
    plan["simulation"]["samples"] = samples;
    return plan;
  }
  // A plan whose simulation has completed two batches of 32.
  std::uint64_t begin_simulation(std::uint64_t samples) {
    const std::uint64_t id = runs_->add(plan_of(samples), shop_);
    EXPECT_TRUE(wait([&] {
      const PlanRun& now = run(id);
      return (now.state == RunState::running && now.progress.task == "simulating" &&
              now.progress.share > 0.07) ||
             !now.is_active();
    }));
    EXPECT_TRUE(run(id).is_active());
    return id;
  }
  void write_plan(
      const std::string& folder, const std::string& signals = "",
      const std::string& placement =
          R"({"count": 2, "count_lower_bound": 1, "labels": 5, "selected": ["a", "b"], "complete": true})") {
    folder_.write(folder + "/placement.json", placement);
    folder_.write(folder + "/signal.h5", signals);
  }

  TempFolder folder_;
  std::string shop_ = "first";
  std::optional<PlanRuns> runs_;
};

TEST_F(PlanRunsOfAShop, AnswerFirstByPreviewsAndThenCertified) {
  open();
  const std::uint64_t id = runs_->add(quick_plan, shop_);
  ASSERT_TRUE(wait([&] { return run(id).state == RunState::previewing; }));
  ASSERT_TRUE(wait([&] { return run(id).state == RunState::running; }));
  EXPECT_FALSE(run(id).first.at("selected").empty());
  EXPECT_FALSE(fs::exists(folder_ / "plan")) << "a first answer leaves no files";
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_EQ(run(id).state, RunState::done);
  EXPECT_EQ(run(id).result.at("event"), "result");
  EXPECT_FALSE(run(id).result.at("answer").get<std::string>().empty());
  EXPECT_EQ(runs_->take_finished(), std::vector<std::uint64_t>{id});
  EXPECT_TRUE(fs::exists(folder_ / "plan" / "report.html"));
  // The next one reuses the signals, and has a folder of its own.
  Json failure = quick_plan;
  failure["problem"]["survives_failure"] = true;
  const std::uint64_t next = runs_->add(failure, shop_);
  ASSERT_TRUE(wait_for_end(next));
  EXPECT_EQ(run(next).folder, "plan-2");
  EXPECT_GT(run(next).result.at("units"), run(id).result.at("units"));
}

TEST_F(PlanRunsOfAShop, EndWhenTheyAreCancelled) {
  open();
  const std::uint64_t id = begin_simulation(400'000), waiting = runs_->add(quick_plan, shop_);
  EXPECT_EQ(run(waiting).state, RunState::waiting);
  runs_->cancel(waiting);
  EXPECT_EQ(run(waiting).state, RunState::stopped);
  runs_->cancel(id);
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_EQ(run(id).state, RunState::stopped);
  EXPECT_TRUE(run(id).has_plan());
  EXPECT_EQ(run(id).result.at("complete"), false);
  expect_input_error([&] { runs_->cancel(id); }, "has ended already");
  expect_input_error([&] { runs_->forget(id); }, "has a result");
  runs_->forget(waiting);
  EXPECT_EQ(runs_->find(waiting), nullptr);
  expect_input_error([&] { runs_->forget(waiting); }, "not in the list");
}

TEST_F(PlanRunsOfAShop, ContinueWhenTheProgramHasEnded) {
  open();
  const std::uint64_t whole = runs_->add(plan_of(30'000), shop_);
  ASSERT_TRUE(wait_for_end(whole));
  fs::rename(folder_ / "plan", folder_ / "other");  // so that its signals are not found
  fs::remove(folder_ / "other" / "placement.json");
  const std::uint64_t id = begin_simulation(30'000);
  runs_.reset();
  open();
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_TRUE(run(id).is_continued);
  EXPECT_EQ(run(id).state, RunState::done) << run(id).result.dump();
  EXPECT_EQ(read_file(folder_ / run(id).folder / "labels.csv"), read_file(folder_ / "other" / "labels.csv"));
}

TEST_F(PlanRunsOfAShop, DoNotContinueWithAnotherShop) {
  open();
  const std::uint64_t id = begin_simulation(400'000);
  runs_.reset();
  shop_ = "second";
  open();
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_EQ(run(id).state, RunState::stopped);
  EXPECT_TRUE(run(id).has_plan()) << "the units so far";
  EXPECT_EQ(run(id).shop, "first");
}

TEST_F(PlanRunsOfAShop, StayEndedWhenTheProgramEndsBefore) {
  folder_.write(".shelfbeam/plans.json",
                R"({"format": 1, "runs": [{"id": 4, "folder": "plan", "plan": {}, "begun": "", "ended": "",
                    "state": "running", "shop": "first", "written": 0, "continued": false, "entered": false,
                    "cancelled": true, "first": null, "result": null}]})");
  open();
  EXPECT_EQ(run(4).state, RunState::stopped);
}

// A shop is planned as it is when it is read, and without signals that cannot be read.
TEST_F(PlanRunsOfAShop, NeedNoSignalsThatCannotBeRead) {
  write_plan("old", "half a copy");
  open();
  const std::uint64_t id = runs_->add(quick_plan, shop_);
  runs_->poll([this]() -> const std::string& { return shop_; });
  shop_ = "second";
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_EQ(run(id).state, RunState::done) << run(id).result.dump();
  EXPECT_EQ(run(id).shop, "second");
}

TEST_F(PlanRunsOfAShop, ListPlansOfOtherPrograms) {
  write_plan("mine");
  write_plan("yours", "", "{");
  open();
  ASSERT_TRUE(wait([&] { return runs_->all().size() == 1; }));
  EXPECT_EQ(runs_->all().front().folder, "mine");
  EXPECT_EQ(runs_->all().front().result.at("units"), 2);
  runs_.reset();
  open();  // from the list
  EXPECT_EQ(runs_->all().size(), 1U);
  // It stays without its signals, at the next look, too.
  fs::remove(folder_ / "mine" / "signal.h5");
  write_plan("next");
  ASSERT_TRUE(wait([&] { return runs_->all().size() == 2; }));
  for (const char* folder : {"mine", "next"}) fs::remove_all(folder_ / folder);
  EXPECT_TRUE(wait([&] { return runs_->all().empty(); }));
}

TEST_F(PlanRunsOfAShop, RefuseWrongRequestsAndListsOfNobody) {
  folder_.write(".shelfbeam/plans.json", "[1");
  open();
  expect_input_error([&] { runs_->add({{"seeds", 1}}, shop_); }, "seeds");
  expect_input_error([&] { runs_->add({{"at_most", 0}}, shop_); }, "at_most");
  EXPECT_TRUE(runs_->all().empty());
  EXPECT_EQ(read_file(folder_ / ".shelfbeam" / "plans.json.unreadable"), "[1");
}

TEST_F(PlanRunsOfAShop, StayInTheFolderOfTheProject) {
  const std::string entry = R"("plan": {}, "begun": "", "ended": "", "state": "waiting", "shop": "first",
      "written": 0, "continued": false, "entered": false, "first": null, "result": null})";
  folder_.write(".shelfbeam/plans.json", R"({"format": 1, "runs": [{"id": 1, "folder": "../x", )" + entry +
                                             R"(, {"id": 2, "folder": "..", )" + entry +
                                             R"(, {"id": 3}, {"id": 4, "folder": "plan", )" + entry + "]}");
  open();
  ASSERT_EQ(runs_->all().size(), 1U);
  EXPECT_EQ(runs_->all().front().id, 4U);
}

}  // namespace
}  // namespace shelfbeam::serve
