#include "jobs/run_file.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"

#include "support/temp_folder.hpp"

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

}  // namespace
}  // namespace shelfbeam::jobs
