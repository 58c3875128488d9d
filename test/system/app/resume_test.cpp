#include <chrono>
#include <csignal>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using test::expect_silent;
using test::names;
using test::small_store;

class Killed : public test::ProgramTest {
 protected:
  std::vector<std::string> arguments(const std::string& output, const std::vector<std::string>& more) const {
    auto all = test::words(folder, "simulate @store.json --checkpoint-interval 0 -o @" + output);
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
};

// Kills the program repeatedly, each time a little later, until a run completes.
TEST_F(Killed, ASimulationResumesToTheSameBytes) {
  const std::vector<std::vector<std::string>> rules{
      {"--samples", "10000"}, {"--relative-error", "0.1", "--direct", "exact", "--quiet"}};
  for (const auto& rule : rules) {
    expect_silent(arguments("whole.h5", rule));
    auto resumed = rule;
    resumed.push_back("--resume");
    double delay = 0.005;
    int kills = 0, with_checkpoint = 0;
    for (;; delay *= 1.15) {
      test::Process process(test::command(arguments("signal.h5", resumed)));
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      process.send(SIGKILL);
      const test::Outcome outcome = process.wait();
      if (outcome.exit_code == 0) break;
      ASSERT_EQ(outcome.exit_code, 128 + SIGKILL) << outcome.err;
      ++kills;
      with_checkpoint += std::filesystem::exists(path("signal.h5.checkpoint")) ? 1 : 0;
    }
    EXPECT_GT(kills, 3);
    EXPECT_GT(with_checkpoint, 0);
    EXPECT_TRUE(read_file(folder / "signal.h5") == read_file(folder / "whole.h5"));
    EXPECT_FALSE(std::filesystem::exists(path("signal.h5.checkpoint")));
    std::filesystem::remove(folder / "signal.h5");
  }
}

TEST_F(Killed, ACheckpointIsForItsOwnSimulationOnly) {
  const auto killed = [&] {
    test::Process process(test::command(arguments("signal.h5", {"--samples", "400000"})));
    process.wait_for_changes(path("signal.h5.checkpoint"), 1);
    process.send(SIGKILL);
    ASSERT_EQ(process.wait().exit_code, 128 + SIGKILL);
    remove_abandoned(path("signal.h5"));  // else the next run does it, which must change nothing below
  };
  killed();
  test::expect_refused(folder, arguments("signal.h5", {"--samples", "400000", "--seed", "2", "--resume"}),
                       {"signal.h5.checkpoint: ", "seed is '1'", "(--resume)"});
  test::Json other = small_store();
  other["materials"]["m"]["reflectance"] = 0.31;
  folder.write("store.json", other.dump());
  test::expect_refused(folder, arguments("signal.h5", {"--samples", "400000", "--resume"}),
                       {"signal.h5.checkpoint", "store hash is '"});
  // Without --resume the checkpoint is replaced, and removed at the end.
  expect_silent(arguments("signal.h5", {"--samples", "64"}));
  EXPECT_EQ(names(folder.path()), (std::set<std::string>{"signal.h5", "store.json"}));
}

TEST_F(Killed, APlanResumesToTheSameBytes) {
  const std::string plan = "plan @store.json --samples 20000 -o ";
  told(plan + "@whole");
  test::Process process(test::command(test::words(folder, plan + "@plan --checkpoint-interval 0")));
  process.wait_for_changes(path("plan/signal.h5.checkpoint"), 1);
  process.send(SIGKILL);
  ASSERT_EQ(process.wait().exit_code, 128 + SIGKILL);
  told(plan + "@plan --resume");
  EXPECT_TRUE(read_file(folder / "plan/signal.h5") == read_file(folder / "whole/signal.h5"));
  EXPECT_FALSE(std::filesystem::exists(path("plan/signal.h5.checkpoint")));
}

}  // namespace
}  // namespace shelfbeam
