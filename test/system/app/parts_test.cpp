// Tests simulations in parts through the program.

#include <chrono>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "system/app/program.hpp"

namespace shelfbeam {
namespace {

using testing::HasSubstr;

class Parts : public test::ProgramTest {
 protected:
  void SetUp() override { space_labels(0.05); }

  // Up to 0.1 m there are enough labels for four groups of neighbours, up to 0.2 m for two.
  void space_labels(double metres) const {
    test::Json store = test::small_store();
    store["fixtures"][0]["labels"]["spacing"] = metres;
    folder.write("store.json", store.dump());
  }

  // Kills the simulation of a part repeatedly, each time a little later. Returns the number of kills.
  int simulate_with_kills(const std::string& options, const std::string& output) const {
    int kills = 0;
    for (double delay = 0.02;; delay *= 1.3) {
      test::Process process(test::command(test::words(
          folder, fmt::format("simulate @store.json {} -o @{} --checkpoint-interval 0 --resume --threads 1",
                              options, output))));
      std::this_thread::sleep_for(std::chrono::duration<double>(delay));
      process.send(SIGKILL);
      const test::Outcome outcome = process.wait();
      if (outcome.exit_code == 0) return kills;
      EXPECT_EQ(outcome.exit_code, 128 + SIGKILL) << outcome.err;
      if (outcome.exit_code != 128 + SIGKILL) return kills;
      ++kills;
    }
  }

  // Simulates four parts, two at a time, with kills, and merges them in another order.
  void expect_the_bytes_of_one_run(const std::string& options) const {
    told(fmt::format("simulate @store.json {} -o @whole.h5", options));
    int kills[2] = {};
    const auto half = [&](int first) {
      for (const int number : {first, first + 2})
        kills[first - 1] +=
            simulate_with_kills(fmt::format("{} --part {}/4", options, number), fmt::format("{}.h5", number));
    };
    std::thread other([&] { half(2); });
    half(1);
    other.join();
    EXPECT_GT(kills[0], 2);
    EXPECT_GT(kills[1], 2);
    EXPECT_THAT(told("merge @3.h5 @1.h5 @4.h5 @2.h5 -o @merged.h5"), HasSubstr("from 4 parts"));
    EXPECT_TRUE(bytes("merged.h5") == bytes("whole.h5"));
    EXPECT_EQ(test::names(folder.path()),
              (std::set<std::string>{"1.h5", "2.h5", "3.h5", "4.h5", "merged.h5", "store.json", "whole.h5"}));
  }
};

using PartsSlow = Parts;

TEST_F(PartsSlow, OfKilledSimulationsMergeToTheBytesOfOneRun) {
  expect_the_bytes_of_one_run("--samples 6000");
}

TEST_F(Parts, OfTheUniformEstimatorMergeToTheBytesOfOneRun) {
  space_labels(0.1);
  expect_the_bytes_of_one_run("--samples 2000 --max-bounces 3 --by-bounce --seed 5");
}

TEST_F(Parts, OfKilledStatesMergeToTheBytesOfOneRun) {
  test::Json store = test::small_store();
  store["variation"] = {{"unit_power_db", 1}};
  folder.write("store.json", store.dump());
  expect_the_bytes_of_one_run("--states 40 --hard-labels 3");
}

TEST_F(Parts, AreThePlanOfOneRun) {
  space_labels(0.2);
  told("plan @store.json --samples 2000 -o @one");
  for (const int number : {1, 2})
    told(fmt::format("simulate @store.json --samples 2000 --part {0}/2 -o @{0}.h5", number));
  told("merge @1.h5 @2.h5 -o @signal.h5");
  EXPECT_THAT(told("plan @store.json --signal @signal.h5 -o @merged"), HasSubstr("read from "));
  for (const char* name : {"signal.h5", "store.json", "labels.csv", "placement.csv", "mounting.csv"})
    EXPECT_TRUE(bytes(fmt::format("merged/{}", name)) == bytes(fmt::format("one/{}", name))) << name;
  EXPECT_EQ(json("merged/placement.json")["chosen"], json("one/placement.json")["chosen"]);

  refused("plan @store.json --signal @1.h5 -o @other", {"1.h5: is part 1 of 2", "merge all parts"});
  // The samples apply if the signals do not fit.
  const std::string fewer = "plan @store.json --no-certificate --signal @signal.h5 --samples 64 -o @";
  EXPECT_THAT(told(fewer + "fitting"), HasSubstr("read from "));
  EXPECT_TRUE(bytes("fitting/signal.h5") == bytes("signal.h5"));
  EXPECT_THAT(told(fewer + "misfit --max-bounces 1"), HasSubstr("another number of bounces"));
  told("plan @store.json --no-certificate --samples 64 --max-bounces 1 -o @simulated");
  EXPECT_TRUE(bytes("misfit/signal.h5") == bytes("simulated/signal.h5"));
  refused("place @1.h5", {"1.h5: is part 1 of 2"});
  refused("merge @1.h5 -o @again.h5", {"number 2 is missing", "simulate them, or name their files"});
  refused("merge @1.h5 @2.h5 -o @1.h5", {"is also the input"});
  refused("simulate @store.json --part 3/2 -o @3.h5", {"--part: '3/2' is not a part such as 2/4"});
  refused("simulate @store.json --part 1/2 --time 5 -o @3.h5", {"--time", "--part"});
  refused("simulate @store.json --part 1/5000 -o @3.h5", {"is too small: the labels form", "use at most"});
  refused("simulate @store.json --part 1/2 --strategy particle -o @3.h5", {"requires walks from labels"});
}

// The plan reads the states of all parts as if it had simulated them.
TEST_F(PartsSlow, ServeAPlanOverStates) {
  test::Json store = test::small_store();
  store["variation"] = {{"unit_power_db", 3}};
  store["materials"]["m"]["reflectance_range"] = {0.25, 0.35};
  folder.write("store.json", store.dump());
  const std::string plan = "plan @store.json --states 20 --no-certificate --samples 500 --seed 3 ";
  const std::string simulate = "simulate @store.json --states 20 --for-plan --seed 3 ";
  told(plan + "-o @one");
  for (const int number : {1, 2, 3}) told(simulate + fmt::format("--part {0}/3 -o @{0}.h5", number));
  told(plan + "-o @sampled --sampled @3.h5 @1.h5 @2.h5");
  const auto states = [&](const std::string& name) { return json(name + "/placement.json")["states"]; };
  EXPECT_EQ(states("sampled"), states("one"));
  // The control: states of other signals give other numbers.
  store["materials"]["m"].erase("reflectance_range");
  folder.write("store.json", store.dump());
  told(plan + "-o @control");
  EXPECT_NE(states("control"), states("one"));

  const std::string other = "plan @store.json --states 20 -o @other --sampled @1.h5 @2.h5 @3.h5";
  refused(other + " --seed 3", {"1.h5: is of another store"});
  store["materials"]["m"]["reflectance_range"] = {0.25, 0.35};
  folder.write("store.json", store.dump());
  refused(other, {"1.h5: has the seed 3 instead of 1"});
  refused(plan + "-o @other --sampled @1.h5 @3.h5", {"number 2 is missing"});
  refused("plan @store.json --states 21 --seed 3 -o @other --sampled @1.h5 @2.h5 @3.h5",
          {"20 states, but the plan needs 21"});
  // States in which another set of causes changes are those of another store.
  refused(plan + "-o @other --without mounting --sampled @1.h5 @2.h5 @3.h5", {"1.h5: is of another store"});
  refused("plan @store.json --states 0 --seed 3 -o @other --sampled @1.h5 @2.h5 @3.h5", {"--sampled"});
  refused("merge @1.h5 @2.h5 @3.h5 -o @merged.h5", {"1.h5: serves a plan"});
  told("simulate @store.json --states 20 --seed 3 --part 1/1 -o @whole.h5");
  refused("plan @store.json --states 20 --seed 3 -o @other --sampled @whole.h5", {"whole.h5: is not a part"});
}

// A part that is stopped writes its checkpoint only.
TEST_F(Parts, ThatAreStoppedResume) {
  const std::string command =
      "simulate @store.json --samples 400000 --part 1/2 -o @1.h5 --checkpoint-interval 0";
  test::Process process(test::command(test::words(folder, command)));
  process.wait_for_changes(path("1.h5.checkpoint"), 2);
  process.send(SIGINT);
  const test::Outcome outcome = process.wait();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("the part was stopped before it was complete"));
  EXPECT_EQ(test::names(folder.path()), (std::set<std::string>{"1.h5.checkpoint", "store.json"}));
  refused("simulate @store.json --samples 400000 --part 2/2 -o @1.h5 --resume",
          {"1.h5.checkpoint: belongs to another simulation", "part is '1 of 2' instead of '2 of 2'"});
}

}  // namespace
}  // namespace shelfbeam
