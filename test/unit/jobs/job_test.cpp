#include <thread>

#include <nlohmann/json.hpp>

#include "shelfbeam/base/file.hpp"

#include "jobs/plan_job.hpp"
#include "support/small_store.hpp"
#include "support/testing.hpp"

namespace shelfbeam::jobs {
namespace {

TEST(Jobs, SimulationsSideBySideAreThoseAlone) {
  const Scene dark = test::SmallStore{.albedo = 0.1}.scene(),
              bright = test::SmallStore{.albedo = 0.6}.scene();
  SimulationOptions options;
  options.samples = 640;
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

TEST(Jobs, CancelledOnesKeepTheirResults) {
  const test::TempFolder folder;
  Stopper stopper;
  PlanJob job;
  job.store = folder.write("store.json", test::SmallStore().text());
  job.folder = folder / "plan";
  job.plan.simulation.samples = 100'000;
  const PlanEnd end = run_plan(job, {.cancel = &stopper.cancel, .progress = &stopper});
  EXPECT_EQ(end.code, stopped_early);
  EXPECT_FALSE(end.plan.complete);
  const auto placement = nlohmann::json::parse(read_file(job.folder / "placement.json"));
  EXPECT_FALSE(placement["complete"].get<bool>());
  EXPECT_THROW(run_plan(job, {.cancel = &stopper.cancel}), Interrupted) << "while the store is read";
}

}  // namespace
}  // namespace shelfbeam::jobs
