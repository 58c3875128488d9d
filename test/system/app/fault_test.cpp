// Regression tests of faults that scripts/hardening/inject-faults found.

#include <cerrno>
#include <chrono>
#include <csignal>
#include <set>
#include <string>
#include <string_view>
#include <thread>

#include <gtest/gtest.h>

#include "support/sanitizers.hpp"
#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::contents;
using test::expect_silent;
using test::TempFolder;
namespace fs = std::filesystem;

class Fault : public testing::Test {
 protected:
  Fault() {
    folder.write("store.json", test::small_store().dump());
    std::filesystem::create_directory(folder / "tmp");
  }
  // The only folder among the temporary files, in which a result was kept.
  fs::path kept() const {
    fs::path found;
    for (const auto& entry : fs::directory_iterator(folder / "tmp")) {
      EXPECT_TRUE(found.empty());
      found = entry.path();
    }
    return found;
  }
  std::string path(const std::string& name) const { return (folder / name).string(); }

  // Runs the program with a file size limit in KiB.
  test::Outcome with_file_size_limit(int limit, const std::vector<std::string>& arguments) {
    std::vector<std::string> all{"/bin/sh", "-c",
                                 "ulimit -f " + std::to_string(2 * limit) + "; exec \"$0\" \"$@\""};
    for (const std::string& word : test::command(arguments)) all.push_back(word);
    return test::run(all);
  }

  // Runs the program, which fails (or, if `error` is 0, is killed) when it renames a file for the n-th time.
  // The next `more` renamings fail, too.
  test::Outcome with_fault_at_renaming(int n, int error, const std::vector<std::string>& arguments,
                                       int more = 0) {
    std::vector<std::string> all{"/usr/bin/env",
                                 std::string("LD_PRELOAD=") + SHELFBEAM_FAULT_SHIM,
                                 "FAULT_OF=rename",
                                 "FAULT_AT=" + std::to_string(n),
                                 "FAULT_ERRNO=" + std::to_string(error),
                                 "TMPDIR=" + path("tmp")};
    all.insert(all.begin() + 1, "FAULT_LASTS=" + std::to_string(more));
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
  for (const char* part : {"signal.h5: ", "File too large", "unchanged"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  auto after = contents(folder.path());
  after.erase("signal.h5.checkpoint");  // the completed simulation
  EXPECT_TRUE(after == before);
}

// The report is the largest file and is written last.
TEST_F(Fault, BeyondAFileSizeLimitTheOldPlanStays) {
  const std::vector<std::string> plan{"plan", path("store.json"), "-o", path("plan"), "--samples", "640"};
  expect_silent(plan);
  const auto before = contents(folder.path());
  std::vector<std::string> other = plan;
  other.insert(other.end(), {"--seed", "2", "--overwrite"});
  const auto kilobytes = [&](const std::string& name) {
    return std::filesystem::file_size(folder / "plan" / name) / 1024;
  };
  const auto between = (kilobytes("signal.h5") + kilobytes("report.html")) / 2;
  ASSERT_GT(between, kilobytes("signal.h5") + 10) << "nothing to tell the two apart by";
  const test::Outcome outcome = with_file_size_limit(static_cast<int>(between), other);
  EXPECT_EQ(outcome.exit_code, 2);
  for (const char* part : {"report.html: ", "File too large", "unchanged"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  auto found = contents(folder.path());
  EXPECT_EQ(found.erase("plan/signal.h5.checkpoint"), 1U);
  EXPECT_TRUE(found == before);
  expect_silent({"report", path("plan")});
}

// A folder that permits no renaming permits no restoration by renaming either.
TEST_F(Fault, AnUnchangedPlanNeedsNoRestoration) {
  if (!test::memory_can_be_limited) GTEST_SKIP() << "faults cannot be preloaded before this sanitizer";
  std::vector<std::string> plan{"plan", path("store.json"), "-o",     path("plan"), "--samples",
                                "64",   "--no-certificate", "--quiet"};
  expect_silent(plan);
  const auto before = contents(folder / "plan");
  plan.insert(plan.end(), {"--overwrite", "--seed", "2"});
  for (const int n : {2, 3}) {  // the journal, the first file of the plan
    const test::Outcome outcome = with_fault_at_renaming(n, EIO, plan, 100);
    EXPECT_EQ(outcome.exit_code, 2);
    auto after = contents(folder / "plan");
    EXPECT_EQ(after.erase("signal.h5.checkpoint"), 1U);
    EXPECT_TRUE(after == before) << n;
  }
}

// If any renaming fails, the old plan stays. If the program is killed at any renaming, each file is the old
// or the new one, the report exists, and there is no placement beside a mixture of both.
TEST_F(Fault, AFailedRenameLosesNoFileOfAPlan) {
  if (!test::memory_can_be_limited) GTEST_SKIP() << "faults cannot be preloaded before this sanitizer";
  const auto plan = [&](const char* seed) {
    return test::words(folder, std::string("plan @store.json -o @plan --samples 64 --estimator uniform "
                                           "--no-certificate --quiet --overwrite --seed ") +
                                   seed);
  };
  const auto files = [&] {
    auto found = contents(folder / "plan");
    std::erase_if(found, [](const auto& file) {
      return file.first == "signal.h5.checkpoint" || file.first == "run.json" || file.first.starts_with(".");
    });
    return found;
  };
  const std::string placement = "placement.json";
  expect_silent(plan("2"));
  const auto after = files();
  expect_silent(plan("1"));
  const auto before = files();
  int failed = 0, mixed = 0;
  for (const int error : {EIO, 0})
    for (int n = 2;; ++n) {  // the first is of the checkpoint, without which a plan is complete, too
      SCOPED_TRACE(testing::Message() << "error " << error << " at renaming " << n);
      const test::Outcome outcome = with_fault_at_renaming(n, error, plan("2"));
      if (outcome.exit_code == 0) break;
      ++failed;
      const auto found = files();
      if (error != 0) {
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find("unchanged"), std::string::npos) << outcome.err;
        EXPECT_TRUE(found == before);
        EXPECT_EQ(test::names(folder / "plan").size(), before.size() + 2)
            << "only run.json and the checkpoint are left beside it";
      } else {
        EXPECT_EQ(outcome.exit_code, 128 + SIGKILL);
        for (const auto& [name, content] : found)
          EXPECT_TRUE(content == before.at(name) || content == after.at(name)) << name;
        EXPECT_EQ(found.count("report.html"), 1U);
        const bool is_mixed = found != before && found != after;
        mixed += is_mixed;
        EXPECT_TRUE(!is_mixed || found.count(placement) == 0);
        expect_silent(plan("1"));
        EXPECT_TRUE(files() == before);
        EXPECT_EQ(test::names(folder / "plan").size(), before.size() + 1)
            << "what the killed one left is gone";
      }
    }
  EXPECT_GE(failed, 2 * static_cast<int>(before.size()));
  EXPECT_GE(mixed, static_cast<int>(before.size()) - 1);
}

TEST_F(Fault, KeepsTheSimulationIfTheOutputCannotBeWritten) {
  const std::vector<std::string> simulation{"simulate",        path("store.json"), "-o",
                                            path("signal.h5"), "--samples",        "640"};
  const test::Outcome outcome = with_file_size_limit(8, simulation);
  EXPECT_EQ(outcome.exit_code, 2);
  ASSERT_TRUE(std::filesystem::exists(folder / "signal.h5.checkpoint")) << outcome.err;
  EXPECT_NE(outcome.err.find("(--resume)"), std::string::npos) << outcome.err;
  auto resumed = simulation;
  resumed.push_back("--resume");
  const std::string out = expect_silent(resumed);
  EXPECT_NE(out.find("continued from the checkpoint, which contained "), std::string::npos) << out;
  const std::string bytes = read_file(folder / "signal.h5");
  expect_silent(simulation);
  EXPECT_TRUE(read_file(folder / "signal.h5") == bytes);
}

TEST_F(Fault, APlanThatCannotBeWrittenIsKeptElsewhere) {
  if (!test::memory_can_be_limited) GTEST_SKIP() << "faults cannot be preloaded before this sanitizer";
  const std::vector<std::string> plan{"plan", path("store.json"), "-o", path("plan"), "--samples", "160"};
  expect_silent(plan);
  fs::rename(folder / "plan", folder / "whole");
  // The first renaming is of the checkpoint.
  const test::Outcome outcome = with_fault_at_renaming(2, ENOSPC, plan);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("; the plan is kept in '" + kept().string() + "'"), std::string::npos)
      << outcome.err;
  EXPECT_EQ(test::names(kept()), test::names(folder / "whole"));
  EXPECT_TRUE(read_file(kept() / "signal.h5") == read_file(folder / "whole/signal.h5"));
  EXPECT_EQ(test::names(folder / "plan"), std::set<std::string>{"signal.h5.checkpoint"});
}

// The checkpoint cannot be written either.
TEST_F(Fault, SignalsThatCannotBeWrittenAreKeptElsewhere) {
  if (!test::memory_can_be_limited) GTEST_SKIP() << "faults cannot be preloaded before this sanitizer";
  const std::vector<std::string> simulation{"simulate",        path("store.json"), "-o",
                                            path("signal.h5"), "--samples",        "160"};
  expect_silent(simulation);
  fs::rename(folder / "signal.h5", folder / "whole.h5");
  const test::Outcome outcome = with_fault_at_renaming(1, ENOSPC, simulation, 1);
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("; the simulated signals are kept in '" + (kept() / "signal.h5").string() + "'"),
            std::string::npos)
      << outcome.err;
  EXPECT_TRUE(read_file(kept() / "signal.h5") == read_file(folder / "whole.h5"));
}

// A batch of two billion samples per label never ends.
TEST_F(Fault, HangupStopsLikeInterrupt) {
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
