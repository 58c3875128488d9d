// What scripts/hardening/inject-faults found, one test each.

#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::contents;
using test::expect_silent;
using test::TempFolder;

class Fault : public testing::Test {
 protected:
  Fault() { folder.write("store.json", test::small_store().dump()); }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  // Runs the program where no file may have more than so many KiB.
  test::Outcome with_file_size_limit(int limit, const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"/bin/sh", "-c",
                                 "ulimit -f " + std::to_string(2 * limit) + "; exec \"$0\" \"$@\""};
    for (const std::string& word : test::command(arguments)) all.push_back(word);
    return test::run(all);
  }
  TempFolder folder;
};

TEST_F(Fault, BeyondAFileSizeLimitTheOldFileStays) {
  expect_silent({"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "640", "--seed", "2"});
  const auto before = contents(folder.path());
  const test::Outcome outcome =
      with_file_size_limit(4, {"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "640"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("signal.h5: cannot be written (File too large"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("stays as it was"), std::string::npos) << outcome.err;
  auto after = contents(folder.path());
  after.erase("signal.h5.checkpoint");  // what was simulated
  EXPECT_TRUE(after == before);
}

// The report is the largest file, and the last.
TEST_F(Fault, BeyondAFileSizeLimitTheOldPlanStays) {
  const std::vector<std::string> plan{"plan", path("store.json"), "-o", path("plan"), "--samples", "640"};
  expect_silent(plan);
  const auto before = contents(folder.path());
  std::vector<std::string> other = plan;
  other.insert(other.end(), {"--seed", "2"});
  const auto kilobytes = [&](const std::string& name) {
    return std::filesystem::file_size(folder / "plan" / name) / 1024;
  };
  const auto between = (kilobytes("signal.h5") + kilobytes("report.html")) / 2;
  ASSERT_GT(between, kilobytes("signal.h5") + 10) << "nothing to tell the two apart by";
  const test::Outcome outcome = with_file_size_limit(static_cast<int>(between), other);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("report.html: cannot be written (File too large) and stays as it was"),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(contents(folder.path()) == before);
  expect_silent({"report", path("plan")});
}

TEST_F(Fault, WhatWasSimulatedIsKeptWhereTheOutputCannotBeWritten) {
  const std::vector<std::string> simulation{"simulate",        path("store.json"), "-o",
                                            path("signal.h5"), "--samples",        "640"};
  const test::Outcome outcome = with_file_size_limit(8, simulation);
  EXPECT_EQ(outcome.exit_code, 2);
  ASSERT_TRUE(std::filesystem::exists(folder / "signal.h5.checkpoint")) << outcome.err;
  EXPECT_NE(outcome.err.find("the same command with '--resume' goes on"), std::string::npos) << outcome.err;
  auto resumed = simulation;
  resumed.push_back("--resume");
  const std::string out = expect_silent(resumed);
  EXPECT_NE(out.find("went on from the checkpoint, which had "), std::string::npos) << out;
  const std::string bytes = read_file(folder / "signal.h5");
  expect_silent(simulation);
  EXPECT_TRUE(read_file(folder / "signal.h5") == bytes);
}

// A batch of two billion samples a label never ends.
TEST_F(Fault, AHangupStopsAsCtrlCDoes) {
  test::Outcome outcome;
  for (std::chrono::milliseconds delay{300}; delay < std::chrono::seconds{20}; delay *= 2) {
    test::Process process(test::command({"simulate", path("store.json"), "-o", path("signal.h5"), "--samples",
                                         "60000000000", "--estimator", "uniform"}));
    std::this_thread::sleep_for(delay);
    process.send(SIGHUP);
    outcome = process.wait();
    if (outcome.exit_code != 128 + SIGHUP) break;
  }
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(outcome.err.starts_with("stopped: ")) << outcome.err;
}

}  // namespace
}  // namespace shelfbeam
