#include "serve/planning/plan_runs.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"
#include "unit/plan/plan_store.hpp"

namespace shelfbeam::serve {
namespace {

namespace fs = std::filesystem;

using test::expect_input_error;

const Json quick_plan{{"seed", 3}, {"budget", 20}};

class PlanRunsOfAShop : public testing::Test {
 protected:
  PlanRunsOfAShop() {
    folder_.write("store.json", test::PlanStore().text());
    fs::create_directory(folder_ / ".shelfbeam");
  }

  void open() { runs_.emplace(folder_.path(), SHELFBEAM_BINARY); }
  const PlanRun& run(std::uint64_t id) const { return *runs_->find(id); }
  bool wait(const std::function<bool()>& is, std::chrono::seconds time = std::chrono::seconds(120)) {
    for (const auto end = std::chrono::steady_clock::now() + time; std::chrono::steady_clock::now() < end;
         std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
      runs_->poll([this]() -> const std::string& { return shop_; });
      if (is()) return true;
    }
    return false;
  }
  bool wait_for_end(std::uint64_t id) {
    return wait([&] { return !run(id).is_active(); });
  }

  test::TempFolder folder_;
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
  Json precise = quick_plan;
  precise["simulation"]["samples"] = 50'000'000;
  const std::uint64_t id = runs_->add(precise, shop_), waiting = runs_->add(quick_plan, shop_);
  ASSERT_TRUE(wait([&] { return run(id).progress.task == "simulating"; }));
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
  Json precise = quick_plan;
  precise["simulation"]["samples"] = 200'000;
  const std::uint64_t whole = runs_->add(precise, shop_);
  ASSERT_TRUE(wait_for_end(whole));
  fs::rename(folder_ / "plan", folder_ / "other");  // so that its signals are not found
  fs::remove(folder_ / "other" / "placement.json");
  const std::uint64_t id = runs_->add(precise, shop_);
  ASSERT_TRUE(wait([&] { return run(id).progress.task == "simulating"; }));
  runs_.reset();
  open();
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_TRUE(run(id).is_continued);
  EXPECT_EQ(run(id).state, RunState::done) << run(id).result.dump();
  EXPECT_EQ(read_file(folder_ / run(id).folder / "labels.csv"), read_file(folder_ / "other" / "labels.csv"));
}

TEST_F(PlanRunsOfAShop, DoNotContinueWithAnotherShop) {
  open();
  Json precise = quick_plan;
  precise["simulation"]["samples"] = 50'000'000;
  const std::uint64_t id = runs_->add(precise, shop_);
  ASSERT_TRUE(wait([&] { return run(id).progress.task == "simulating"; }));
  runs_.reset();
  shop_ = "second";
  open();
  ASSERT_TRUE(wait_for_end(id));
  if (!fs::exists(folder_ / "plan" / "placement.json")) {  // the processor was too busy for its units
    EXPECT_THAT(run(id).result.at("message").get<std::string>(), testing::HasSubstr("has changed"));
    return;
  }
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

TEST_F(PlanRunsOfAShop, NeedNoSignalsThatCannotBeRead) {
  folder_.write("old/placement.json", R"({"count": 0, "count_lower_bound": 0, "labels": 5, "selected": []})");
  folder_.write("old/signal.h5", "half a copy");
  open();
  const std::uint64_t id = runs_->add(quick_plan, shop_);
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_EQ(run(id).state, RunState::done) << run(id).result.dump();
}

TEST_F(PlanRunsOfAShop, StayInTheListWithoutTheirSignals) {
  folder_.write("mine/placement.json",
                R"({"count": 0, "count_lower_bound": 0, "labels": 5, "selected": []})");
  folder_.write("mine/signal.h5", "");
  open();
  ASSERT_TRUE(wait([&] { return runs_->all().size() == 1; }));
  fs::remove(folder_ / "mine" / "signal.h5");
  EXPECT_FALSE(wait([&] { return runs_->all().empty(); }, std::chrono::seconds(3)));
}

TEST_F(PlanRunsOfAShop, PlanTheShopAsItIsWhenItIsRead) {
  open();
  const std::uint64_t id = runs_->add(quick_plan, shop_);
  runs_->poll([this]() -> const std::string& { return shop_; });
  shop_ = "second";
  ASSERT_TRUE(wait_for_end(id));
  EXPECT_EQ(run(id).shop, "second");
}

TEST_F(PlanRunsOfAShop, ListPlansOfOtherPrograms) {
  folder_.write("mine/signal.h5", "");
  folder_.write(
      "mine/placement.json",
      R"({"count": 2, "count_lower_bound": 1, "labels": 5, "selected": ["a", "b"], "complete": true})");
  folder_.write("yours/signal.h5", "");
  folder_.write("yours/placement.json", "{");
  open();
  ASSERT_TRUE(wait([&] { return runs_->all().size() == 1; }));
  EXPECT_EQ(runs_->all().front().folder, "mine");
  EXPECT_EQ(runs_->all().front().result.at("units"), 2);
  runs_.reset();
  open();  // from the list
  EXPECT_EQ(runs_->all().size(), 1U);
  fs::remove_all(folder_ / "mine");
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
