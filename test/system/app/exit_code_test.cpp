#include <algorithm>
#include <chrono>
#include <csignal>
#include <random>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"

#include "system/app/program.hpp"

// Exit codes 0 and 2 are tested in workflow_test.cpp and bad_input_test.cpp.

namespace shelfbeam {
namespace {

using test::Json;
using test::names;
using test::small_store;

class ExitCode : public test::ProgramTest {};

TEST_F(ExitCode, OneIfInfeasible) {
  Json store = small_store();
  store["label_types"]["standard"]["threshold"] = 100;
  folder.write("greedy.json", store.dump());
  const std::string out = told("plan @greedy.json -o @plan --samples 320", 1);
  EXPECT_NE(out.find("\nNo selection reaches all 17 labels, with 99 % confidence"), std::string::npos) << out;
  EXPECT_EQ(names(folder / "plan").size(), 11u);
  const std::string report = bytes("plan/report.html");
  EXPECT_NE(report.find("No selection reaches all 17 labels"), std::string::npos);
  told("report @plan");
  EXPECT_EQ(bytes("plan/report.html"), report);
  told("place @plan/signal.h5 -o @placement.json --model non-cooperative", 1);
  const Json placement = json("placement.json");
  EXPECT_EQ(placement["status"], "infeasible");
  EXPECT_EQ(placement["unreachable"].size(), 17u);
  EXPECT_GT(placement["unreachable"][0]["most"], 0.0);
  told("place @plan/signal.h5 --threshold 1e-9");
}

// Two spots at one mounting point, and on either side a label that only one of them reaches.
TEST_F(ExitCode, OneIfOptionsConflict) {
  folder.write("spots.json", R"({
    "room": { "size": [8, 6, 3], "floor": "m", "ceiling": "m", "walls": "m" },
    "materials": { "m": { "type": "lambertian", "reflectance": 0 } },
    "label_types": { "standard": { "threshold": 0.3 } },
    "transceiver_types": { "spot": { "emission": { "type": "lambertian", "order": 20, "flux": 5 } } },
    "labels": [ { "id": "west", "position": [0.1, 3, 1.5], "normal": [1, 0, 0], "type": "standard" },
                { "id": "east", "position": [7.9, 3, 1.5], "normal": [-1, 0, 0], "type": "standard" } ],
    "transceivers": { "list": [
      { "id": "to west", "position": [4, 3, 2.9], "axis": [-1, 0, -0.36], "type": "spot" },
      { "id": "to east", "position": [4, 3, 2.9], "axis": [1, 0, -0.36], "type": "spot" } ] }
  })");
  std::string out = told("plan @spots.json -o @plan --samples 320 --curve --sensitivity", 1);
  for (const char* missing : {"no curve without a placement", "no sensitivity without a placement"})
    EXPECT_NE(out.find(missing), std::string::npos) << out;
  EXPECT_EQ(json("plan/placement.json")["status"], "infeasible");
  EXPECT_TRUE(json("plan/placement.json")["unreachable"].empty());
  told("report @plan");
  // Greedy cannot prove infeasibility.
  out = told("place @plan/signal.h5 -o @p.json --solver greedy", 3);
  EXPECT_NE(out.find("A MIP solver may find one"), std::string::npos) << out;
  EXPECT_EQ(json("p.json")["status"], "stopped");
  told("plan @spots.json -o @plan --samples 320 --solver greedy --overwrite", 3);
}

// A random cover of 300 labels by 200 units: no exact solver proves it in a millisecond.
std::string hard_matrix() {
  std::mt19937 random(1);
  std::string csv;
  for (int i = 0; i < 300; ++i) {
    for (int j = 0; j < 200; ++j)
      csv += fmt::format("{}{}", j == 0 ? "" : ",", random() % 16 == 0 ? random() % 9 : 0);
    csv += '\n';
  }
  return csv;
}

// The first samples certify all labels, and nothing is left for the proof of the bound.
TEST_F(ExitCode, ZeroIfOnlyTheBoundIsOpen) {
  const std::string plan = "plan @store.json -o @plan --overwrite --samples 2000 --budget 1e-6";
  const std::string out = told(plan);
  const Json placement = json("plan/placement.json"), certificate = placement["certificate"];
  EXPECT_EQ(certificate["reached"], 17);
  EXPECT_FALSE(certificate["open"].is_null());
  ASSERT_LT(certificate["count_lower_bound"], placement["count"]);
  const std::string sentence = fmt::format(
      "All 17 labels are certified, so the plan can be mounted as it is; whether fewer transceivers are "
      "enough "
      "is open: {} to {}",
      certificate["count_lower_bound"].get<int>(), placement["count"].get<int>());
  EXPECT_NE(out.find('\n' + sentence), std::string::npos) << out;
  EXPECT_NE(out.find("A larger budget of the certificate may decide this (--budget).\n"), std::string::npos)
      << out;
  EXPECT_NE(bytes("plan/report.html").find(sentence), std::string::npos);

  // The control: a label for which all candidates together are just enough.
  Json store = small_store();
  double& threshold = store["label_types"]["standard"]["threshold"].get_ref<double&>();
  threshold = 0.5;
  folder.write("store.json", store.dump());
  told(plan, 1);
  const Json infeasible = json("plan/placement.json");
  for (const Json& label : infeasible["unreachable"])
    threshold = std::min(threshold, label["most"].get<double>() * (1 - 1e-6));
  folder.write("store.json", store.dump());
  const std::string undecided = told(plan, 3);
  EXPECT_EQ(undecided.find("are certified"), std::string::npos) << undecided;
  EXPECT_NE(undecided.find("may decide this (--budget).\n"), std::string::npos) << undecided;
}

TEST_F(ExitCode, ThreeAtTheTimeLimit) {
  folder.write("hard.csv", hard_matrix());
  for (const milp::Backend& backend : milp::backends()) {
    const std::string out = told(
        "place @hard.csv --threshold 6 -o @p.json --time-limit 0.001 --backend " + std::string(backend.name),
        3);
    EXPECT_NE(out.find("\n  stopped: value "), std::string::npos) << out;
    const Json placement = json("p.json");
    EXPECT_EQ(placement["status"], "stopped");
    EXPECT_GT(placement["count"], 0);
    EXPECT_GT(placement["count_lower_bound"], 0);
    EXPECT_LT(placement["count_lower_bound"], placement["count"]);
    EXPECT_GT(placement["gap"], 0.0);
  }
}

TEST_F(ExitCode, ThreeIfGreedyAndCurveReachedTheTimeLimit) {
  folder.write("hard.csv", hard_matrix());
  const std::string out =
      told("place @hard.csv --threshold 6 --solver greedy --curve -o @p.json --time-limit 1e-6", 3);
  EXPECT_NE(out.find("the curve was stopped early"), std::string::npos) << out;
  EXPECT_EQ(json("p.json")["status"], "stopped");
  EXPECT_EQ(json("p.json")["curve_complete"], false);
}

using Clock = std::chrono::steady_clock;

// Sends SIGINT `delay` seconds after the start. The program must end within a few seconds, although its work
// takes hours.
test::Outcome interrupted(std::vector<std::string> arguments, double delay) {
  test::Process process(test::command(std::move(arguments)));
  std::this_thread::sleep_for(std::chrono::duration<double>(delay));
  const auto sent = Clock::now();
  process.send(SIGINT);
  test::Outcome outcome = process.wait();
  EXPECT_LT(std::chrono::duration<double>(Clock::now() - sent).count(), 30);
  return outcome;
}

// Interrupts once the program handles signals; before that, SIGINT ends it like any other program.
test::Outcome interrupted_at_work(const std::vector<std::string>& arguments) {
  test::Outcome outcome;
  double delay = 0.3;
  for (int attempt = 0; attempt < 6; ++attempt) {
    outcome = interrupted(arguments, delay);
    if (outcome.exit_code != 128 + SIGINT) break;
    delay *= 2;
  }
  return outcome;
}

TEST_F(ExitCode, ThreeWhenASimulationIsInterrupted) {
  // Interrupts between two of 32 batches, on machines of any speed.
  test::Process process(
      test::command({"simulate", path("store.json"), "-o", path("signal.h5"), "--samples", "400000",
                     "--estimator", "uniform", "--threads", "1", "--json", "--checkpoint-interval", "0"}));
  process.wait_for_changes(path("signal.h5.checkpoint"), 4);
  process.send(SIGINT);
  const test::Outcome outcome = process.wait();
  ASSERT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(Json::parse(outcome.out)["complete"], false);
  EXPECT_EQ(names(folder.path()), (std::set<std::string>{"signal.h5", "signal.h5.checkpoint", "store.json"}));
  const SignalMatrix matrix = read_signal_file(folder / "signal.h5");
  std::uint32_t fewest = 32;
  for (const LabelRow& label : matrix.labels) {
    EXPECT_GE(label.batches, 2u);
    EXPECT_LE(label.batches, 32u);
    EXPECT_EQ(label.samples, label.batches * std::uint64_t{12500});
    fewest = std::min(fewest, label.batches);
  }
  EXPECT_LT(fewest, 32u);
  told("place @signal.h5 -o @placement.json");
  EXPECT_EQ(json("placement.json")["status"], "optimal");
}

TEST_F(ExitCode, ThreeWithoutAFileBeforeTheFirstResult) {
  folder.write("signal.h5", "old");
  for (const char* verb : {"simulate", "plan"}) {
    const std::string output = path(std::string(verb) == "plan" ? "plan" : "signal.h5");
    const auto before = test::contents(folder.path());
    // A batch of 2 billion samples per label never ends.
    const test::Outcome outcome = interrupted_at_work(
        {verb, path("store.json"), "-o", output, "--samples", "60000000000", "--estimator", "uniform"});
    EXPECT_EQ(outcome.exit_code, 3) << verb;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("stopped: ")) << outcome.err;
    std::filesystem::remove(folder / "plan");  // empty
    EXPECT_TRUE(test::contents(folder.path()) == before);
  }
}

TEST_F(ExitCode, ThreeWhenAPlacementIsInterrupted) {
  folder.write("hard.csv", hard_matrix());
  const test::Outcome outcome = interrupted_at_work(
      {"place", path("hard.csv"), "--threshold", "6", "-o", path("p.json"), "--time-limit", "7200"});
  EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(json("p.json")["status"], "stopped");
  EXPECT_GT(json("p.json")["count"], 0);
}

}  // namespace
}  // namespace shelfbeam
