#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/checkpoint/checkpoint.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support/expect_input_error.hpp"
#include "support/small_store.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

// Stops the work at the n-th progress report, after that number of batches of items.
class StopAt : public ProgressSink {
 public:
  StopAt(CancelToken& token, int reports) : token_(token), left_(reports) {}
  void report(Task, double, std::string_view) override {
    if (--left_ <= 0) token_.request();
  }

 private:
  CancelToken& token_;
  int left_;
};

class Resume : public testing::Test {
 protected:
  Resume() { options.checkpoint = {folder / "signal.h5.checkpoint", false, 0}; }

  std::string whole() {
    SimulationOptions alone = options;
    alone.checkpoint = {};
    EXPECT_TRUE(simulate_to_file(scene, alone, folder / "whole.h5", {2}).complete);
    return read_file(folder / "whole.h5");
  }

  // Continues until the n-th report; false if the run ends before.
  bool stopped_after(int reports, unsigned threads) {
    CancelToken token;
    StopAt sink(token, reports);
    try {
      return !simulate_to_file(scene, options, folder / "signal.h5", {threads, &token, &sink}).complete;
    } catch (const Interrupted&) {
      return true;
    }
  }

  void expect_same_after_every_stop(const std::vector<int>& stops) {
    const std::string expected = whole();
    for (const unsigned threads : {1U, 3U})
      for (const int reports : stops) {
        options.checkpoint.resume = false;
        ASSERT_TRUE(stopped_after(reports, threads));
        ASSERT_TRUE(std::filesystem::exists(options.checkpoint.path));
        options.checkpoint.resume = true;
        int next = reports;
        while (stopped_after(next, threads)) ASSERT_LT(next += next / 2 + 1, 100000);
        EXPECT_TRUE(read_file(folder / "signal.h5") == expected) << reports << ' ' << threads;
        EXPECT_FALSE(std::filesystem::exists(options.checkpoint.path));
      }
  }

  test::TempFolder folder;
  Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
};

TEST_F(Resume, GivesTheSameBytesWithAFixedNumberOfSamples) {
  options.samples = 640;
  expect_same_after_every_stop({1, 7, 40, 137});
  options.samples = 641;
  EXPECT_FALSE(whole() == read_file(folder / "signal.h5"));
}

TEST_F(Resume, GivesTheSameBytesWithARelativeError) {
  options.direct = DirectLight::exact;
  options.relative_error = RelativeError{0.05, 0.3};
  expect_same_after_every_stop({5, 170});
}

TEST_F(Resume, GivesTheSameBytesWithAnErrorOutOfReach) {
  options.direct = DirectLight::exact;
  options.relative_error = RelativeError{0.004, 0.3, 20000};
  expect_same_after_every_stop({100, 230});
}

class ResumeSlow : public Resume {};

// With few items, several batches run at once; the end depends on all entries together.
TEST_F(ResumeSlow, GivesTheSameBytesWithSeveralBatchesAtOnce) {
  options.strategy = Strategy::particle;
  options.direct = DirectLight::exact;
  options.relative_error = RelativeError{0.03, 0.3};
  std::vector<int> stops;
  for (int reports = 60; reports < 160; reports += 7) stops.push_back(reports);
  expect_same_after_every_stop(stops);
}

TEST_F(Resume, GivesTheSameBytesByBounceAndForParticles) {
  options.samples = 640;
  options.max_bounces = 3;
  options.by_bounce = true;
  for (const Strategy strategy : {Strategy::mis, Strategy::particle}) {
    options.strategy = strategy;
    expect_same_after_every_stop({9, 50});
  }
}

TEST_F(Resume, StartsAnewWithoutACheckpoint) {
  options.samples = 320;
  options.checkpoint.resume = true;
  EXPECT_FALSE(stopped_after(1 << 20, 1));
  EXPECT_TRUE(read_file(folder / "signal.h5") == whole());
}

// A truncated record is computed again. A changed byte before it is refused, and nothing is written.
TEST_F(Resume, AcceptsATruncatedCheckpointButNotACorruptOne) {
  options.samples = 640;
  const std::string expected = whole();
  ASSERT_TRUE(stopped_after(100, 1));
  const std::string checkpoint = read_file(options.checkpoint.path);
  std::filesystem::remove(folder / "signal.h5");
  options.checkpoint.resume = true;
  for (const std::size_t missing : {1u, 20u, 150u, 400u}) {
    write_file(options.checkpoint.path, checkpoint.substr(0, checkpoint.size() - missing));
    EXPECT_FALSE(stopped_after(1 << 20, 2));
    EXPECT_TRUE(read_file(folder / "signal.h5") == expected) << missing;
  }
  std::filesystem::remove(folder / "signal.h5");
  std::string damaged = checkpoint;
  damaged[checkpoint.size() / 2] = static_cast<char>(damaged[checkpoint.size() / 2] ^ 1);
  write_file(options.checkpoint.path, damaged);
  test::expect_input_error([&] { stopped_after(1 << 20, 2); }, "signal.h5.checkpoint: ", "at byte");
  EXPECT_FALSE(std::filesystem::exists(folder / "signal.h5"));
}

TEST_F(Resume, RefusesAnotherSimulationAndNamesTheDifference) {
  options.samples = 640;
  ASSERT_TRUE(stopped_after(100, 1));
  const auto refused_of = [&](const Scene& shop, const SimulationOptions& other, const std::string& what) {
    SimulationOptions resumed = other;
    resumed.checkpoint.resume = true;
    test::expect_input_error([&] { simulate(shop, resumed); }, "signal.h5.checkpoint", what);
  };
  const auto refused = [&](const SimulationOptions& other, const char* what) {
    refused_of(scene, other, what);
  };
  const Scene darker = test::SmallStore{.albedo = 0.59}.scene();
  refused_of(darker, options, fmt::format("store hash is '{}'", scene.store_hash));
  SimulationOptions other = options;
  other.seed = 2;
  refused(other, "seed is '1'");
  other = options;
  other.strategy = Strategy::nee;
  refused(other, "estimator is 'uniform mis (balance), direct sampled'");
  other = options;
  other.direct = DirectLight::exact;
  refused(other, "estimator is");
  other = options;
  other.max_bounces = 3;
  refused(other, "estimator is");
  other = options;
  other.samples = 64;
  refused(other, "stopping rule is 'samples 640'");
  other = options;
  other.relative_error = RelativeError{0.25, 0.3};
  refused(other, "'relative-error 0.25 above 0.3");
  EXPECT_TRUE(std::filesystem::exists(options.checkpoint.path));
  options.checkpoint.resume = true;
  EXPECT_TRUE(simulate(scene, options).summary.complete);
}

TEST_F(Resume, AStoppedRunReportsItsState) {
  options.samples = 640;
  ASSERT_TRUE(stopped_after(100, 1));
  const SignalMatrix matrix = read_signal_file(folder / "signal.h5");
  std::uint32_t done = 0;
  for (const LabelRow& row : matrix.labels) done += row.batches;
  EXPECT_EQ(done, 100u);
}

}  // namespace
}  // namespace shelfbeam
