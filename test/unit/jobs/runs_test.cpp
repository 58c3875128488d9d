// Tests the processes of runs, and the files about them.

#include <chrono>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"

#include "jobs/plan_process.hpp"
#include "jobs/run_file.hpp"
#include "support/testing.hpp"

namespace shelfbeam::jobs {
namespace {

TEST(RunFile, IsRecognisedUntilItIsChanged) {
  const test::TempFolder folder;
  Plan plan;
  plan.placement.seconds = 0.25;
  plan.certificate.emplace();
  plan.certificate->open = {.cause = EndCause::labels_cost, .labels = 3, .seconds = 40};
  const std::string text = run_json(plan, {2.5, 4, 1 << 20, 2}, "../store.json");
  const auto json = nlohmann::ordered_json::parse(text);
  EXPECT_EQ(json["store"], "../store.json");
  EXPECT_EQ(json["seconds"]["placement"], 0.25);
  EXPECT_FALSE(json["seconds"].contains("states"));
  EXPECT_EQ(json["seconds"]["total"], 2.5);
  EXPECT_EQ(json["processor_seconds"], 4.0);
  EXPECT_EQ(json["seconds_to_decide"], 40.0);
  const auto file = folder.write("run.json", text);
  EXPECT_TRUE(is_run_file(file));
  std::string changed = text;
  changed.replace(changed.find("0.25"), 4, "0.26");
  write_file(file, changed);
  EXPECT_FALSE(is_run_file(file));
  for (const char* other : {"", "{}", "[]", "{\"hash\": 1}"}) {
    write_file(file, other);
    EXPECT_FALSE(is_run_file(file)) << other;
  }
}

TEST(RunFile, MeasuresTheProcess) {
  const RunClock clock;
  volatile double sum = 0;
  for (int k = 0; k < 10'000'000; ++k) sum = sum + 1;
  const RunEffort effort = clock.effort(3);
  EXPECT_GT(effort.cpu_s, 0);
  EXPECT_GE(effort.wall_s, 0);
  EXPECT_GT(effort.peak_memory, 1U << 20);
  EXPECT_EQ(effort.threads, 3U);
}

// A process that ignores an interruption is killed after the patience, and not before.
TEST(PlanProcess, IsKilledAfterThePatience) {
  const test::TempFolder folder;
  const std::filesystem::path deaf =
      folder.write("deaf", "#!/bin/sh\ntrap '' INT\n: > \"$0-is-ready\"\nwhile :; do sleep 0.05; done\n");
  std::filesystem::permissions(deaf, std::filesystem::perms::owner_all);
  PlanProcess process(PlanJob{}, 0, deaf);
  while (!std::filesystem::exists(folder / "deaf-is-ready")) wait_for_children(0.01);
  JobEnd end;
  ChildEnd effort;
  process.interrupt();
  wait_for_children(0.2);
  ASSERT_FALSE(process.has_ended(end, effort));
  process.interrupt(std::chrono::seconds(0));
  while (!process.has_ended(end, effort)) wait_for_children(poll_s);
  EXPECT_EQ(exit_code_of(end), internal_error);
  EXPECT_THAT(std::get<JobError>(end).message, testing::HasSubstr("signal 9"));
}

}  // namespace
}  // namespace shelfbeam::jobs
