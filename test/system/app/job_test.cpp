#include <map>
#include <string>
#include <thread>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "jobs/plan_job.hpp"
#include "system/app/program.hpp"

namespace shelfbeam::jobs {
namespace {

class Jobs : public test::ProgramTest {
 protected:
  void write_store(const std::string& name, double reflectance) {
    test::Json store = test::small_store();
    store["materials"]["m"]["reflectance"] = reflectance;
    folder.write(name, store.dump());
  }

  // The files of a plan in which two equal runs do not differ.
  std::map<std::string, std::string> files(const std::string& plan) const {
    auto found = test::contents(folder / plan);
    found.erase("run.json");
    return found;
  }

  PlanEnd planned(const std::string& store, const std::string& plan) const {
    PlanJob job;
    job.store = folder / store;
    job.folder = folder / plan;
    job.plan.simulation.samples = 640;
    job.threads = 2;
    return run_plan(job, {});
  }
};

TEST_F(Jobs, OneAfterAnotherGiveTheBytesOfTheirOwnProcesses) {
  write_store("dark.json", 0.1);
  write_store("bright.json", 0.6);
  for (const std::string name : {"dark", "bright"})
    told(fmt::format("plan @{0}.json -o @own-{0} --samples 640", name));
  EXPECT_EQ(planned("dark.json", "dark").code, done);
  EXPECT_EQ(planned("bright.json", "bright").code, done);
  planned("dark.json", "again");
  EXPECT_EQ(files("dark"), files("own-dark"));
  EXPECT_EQ(files("bright"), files("own-bright"));
  EXPECT_EQ(files("again"), files("own-dark"));
  EXPECT_NE(files("bright"), files("dark")) << "negative control";
}

TEST_F(Jobs, SimulationsSideBySideAreThoseAlone) {
  write_store("dark.json", 0.1);
  write_store("bright.json", 0.6);
  const Scene dark = make_scene(read_store(folder / "dark.json"));
  const Scene bright = make_scene(read_store(folder / "bright.json"));
  SimulationOptions options;
  options.samples = 2000;
  const auto simulated = [&](const Scene& scene) { return simulate(scene, options, {.threads = 2}).matrix; };
  const SignalMatrix dark_alone = simulated(dark), bright_alone = simulated(bright);
  for (int attempt = 0; attempt < 3; ++attempt) {
    SignalMatrix dark_beside, bright_beside;
    std::thread other([&] { dark_beside = simulated(dark); });
    bright_beside = simulated(bright);
    other.join();
    EXPECT_TRUE(dark_beside == dark_alone && bright_beside == bright_alone) << attempt;
  }
  EXPECT_FALSE(dark_alone == bright_alone) << "negative control";
}

class Stopper : public ProgressSink {
 public:
  CancelToken cancel;

  void report(Task task, double fraction, std::string_view) override {
    if (task == Task::simulating && fraction > 0.3) cancel.request();
  }
};

TEST_F(Jobs, CancelledOnesKeepTheirResults) {
  write_store("store.json", 0.3);
  Stopper stopper;
  PlanJob job;
  job.store = folder / "store.json";
  job.folder = folder / "plan";
  job.plan.simulation.samples = 1'000'000;
  const PlanEnd end = run_plan(job, {.cancel = &stopper.cancel, .progress = &stopper});
  EXPECT_EQ(end.code, stopped_early);
  EXPECT_FALSE(end.plan.complete);
  EXPECT_FALSE(json("plan/placement.json")["complete"].get<bool>());
  EXPECT_THROW(run_plan(job, {.cancel = &stopper.cancel}), Interrupted) << "while the store is read";
}

}  // namespace
}  // namespace shelfbeam::jobs
