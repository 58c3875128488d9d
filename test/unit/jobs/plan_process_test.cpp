#include "jobs/plan_process.hpp"

#include <chrono>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/temp_folder.hpp"

namespace shelfbeam::jobs {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A process that ignores an interruption is killed after the patience, and not before.
TEST(PlanProcess, IsKilledAfterThePatience) {
  const test::TempFolder folder;
  const fs::path deaf =
      folder.write("deaf", "#!/bin/sh\ntrap '' INT\n: > \"$0-is-ready\"\nwhile :; do sleep 0.05; done\n");
  fs::permissions(deaf, fs::perms::owner_all);
  PlanProcess process(PlanJob{}, 0, deaf);
  while (!fs::exists(folder / "deaf-is-ready")) wait_for_children(0.01);
  JobEnd end;
  ChildEnd effort;
  process.interrupt();
  wait_for_children(0.2);
  ASSERT_FALSE(process.has_ended(end, effort));
  process.interrupt(std::chrono::seconds(0));
  while (!process.has_ended(end, effort)) wait_for_children(poll_s);
  EXPECT_EQ(exit_code_of(end), internal_error);
  EXPECT_THAT(std::get<JobError>(end).message, HasSubstr("signal 9"));
}

}  // namespace
}  // namespace shelfbeam::jobs
