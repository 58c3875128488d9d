#include "shelfbeam/transport/run/simulate.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"

#include "physics/comparison.hpp"
#include "support/expect_input_error.hpp"
#include "support/hypothesis.hpp"
#include "support/small_store.hpp"

namespace shelfbeam {
namespace {

SimulationResult run(const Scene& scene, std::uint64_t samples, DirectLight direct = DirectLight::sampled,
                     std::uint64_t seed = 1) {
  return simulate(scene, {EstimatorKind::uniform, samples, direct, seed});
}

TEST(Simulate, EveryStrategyIsBitwiseTheSameForAnyNumberOfThreads) {
  Scene scene = test::SmallStore{}.scene();
  for (TransceiverType& type : scene.transceiver_types) type.radius = 0.1;
  for (LabelType& type : scene.label_types) type.size = {0.1, 0.05};
  for (const Strategy strategy : {Strategy::walk, Strategy::nee, Strategy::mis, Strategy::particle})
    for (const DirectLight direct : {DirectLight::sampled, DirectLight::exact}) {
      SimulationOptions options{EstimatorKind::uniform};
      options.samples = 320;
      options.strategy = strategy;
      options.direct = direct;
      options.max_bounces = 4;
      options.by_bounce = true;
      const auto with = [&](unsigned threads) {
        RunControl control;
        control.threads = threads;
        return simulate(scene, options, control).matrix;
      };
      const SignalMatrix one = with(1);
      for (const unsigned threads : {2U, 3U, 8U}) {
        const SignalMatrix many = with(threads);
        EXPECT_EQ(one.mean, many.mean);
        EXPECT_EQ(one.standard_error, many.standard_error);
        EXPECT_EQ(one.direct, many.direct);
        ASSERT_EQ(one.by_bounce.size(), 5u);
        for (std::size_t k = 0; k < 5; ++k) EXPECT_EQ(one.by_bounce[k].mean, many.by_bounce[k].mean);
      }
      options.seed = 2;
      EXPECT_NE(one.mean, with(1).mean);
    }
}

TEST(Simulate, NamesTheRulesOfItsPaths) {
  Scene scene = test::SmallStore{}.scene();
  for (TransceiverType& type : scene.transceiver_types) type.radius = 0.1;
  SimulationOptions options;
  options.samples = 64;
  const auto expect_named = [&] {
    const std::string name = simulate(scene, options).matrix.provenance.estimator;
    const auto rules = rules_of_estimator(name);
    ASSERT_TRUE(rules) << name;
    EXPECT_EQ(rules->strategy, options.rules().strategy) << name;
    EXPECT_EQ(rules->max_bounces, options.rules().max_bounces) << name;
  };
  expect_named();
  options.estimator = EstimatorKind::uniform;
  for (const Strategy strategy : {Strategy::walk, Strategy::nee, Strategy::mis, Strategy::particle})
    for (const std::uint32_t bounces : {0U, 12U, PathRules::no_limit}) {
      options.strategy = strategy;
      options.max_bounces = bounces;
      expect_named();
    }
  for (const char* other : {"", "uniform", "another program", "nee, at most many bounces"})
    EXPECT_FALSE(rules_of_estimator(other)) << other;
}

TEST(Simulate, RefusesInvalidOptions) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
  options.strategy = Strategy::walk;
  test::expect_input_error([&] { simulate(scene, options); }, "strategy walk: ", "'T0'", "'unit0'");
  options = {EstimatorKind::uniform};
  options.by_bounce = true;
  test::expect_input_error([&] { simulate(scene, options); }, "number of bounces: ");
  for (const SimulationOptions& uniforms : {SimulationOptions{.strategy = Strategy::nee},
                                            {.heuristic = Heuristic::power},
                                            {.max_bounces = 3},
                                            {.by_length = {1, 10}}})
    test::expect_input_error([&] { simulate(scene, uniforms); }, "estimator reuse", "uniform");
  Scene shining = scene;
  shining.materials.push_back({"unused", make_lambertian(0)});
  shining.emitting_surfaces = {{"S", MaterialId{static_cast<std::uint32_t>(scene.materials.size())}, 1}};
  EXPECT_THROW(simulate(shining, {}), std::invalid_argument);
}

TEST(Simulate, PermutedLabelsPermuteTheRowsToTheBit) {
  test::SmallStore store;
  const SignalMatrix before = run(store.scene(), 640).matrix;
  std::reverse(store.labels.begin(), store.labels.end());
  const SignalMatrix after = run(store.scene(), 640).matrix;
  for (std::size_t i = 0; i < before.rows(); ++i) {
    const auto same = std::find_if(after.labels.begin(), after.labels.end(),
                                   [&](const LabelRow& row) { return row.id == before.labels[i].id; });
    const auto there = after.mean_row(static_cast<std::size_t>(same - after.labels.begin()));
    EXPECT_TRUE(std::equal(there.begin(), there.end(), before.mean_row(i).begin())) << before.labels[i].id;
  }
}

TEST(Simulate, DoubledPowerDoublesItsColumnToTheBit) {
  test::SmallStore store;
  const SignalMatrix before = run(store.scene(), 640).matrix;
  store.peaks[2] *= 2;
  const SignalMatrix after = run(store.scene(), 640).matrix;
  for (std::size_t i = 0; i < before.rows(); ++i)
    for (std::size_t j = 0; j < before.columns(); ++j)
      EXPECT_EQ(after.mean[after.at(i, j)], (j == 2 ? 2 : 1) * before.mean[before.at(i, j)]);
}

// z-test of all old columns at 0.1 %, with a relative standard error per entry of about 4 %. The control are
// columns 5/4 as large, the effect of a wrong 1/n, which must be rejected.
TEST(Simulate, AnotherTransceiverLeavesTheOtherColumns) {
  test::SmallStore store;
  const SignalMatrix four = run(store.scene(), 20000, DirectLight::sampled, 1).matrix;
  store.peaks.push_back(1);
  const SignalMatrix five = run(store.scene(), 20000, DirectLight::sampled, 2).matrix;
  SignalMatrix old = four;  // the first four columns of `five`
  for (std::size_t i = 0; i < four.rows(); ++i)
    for (std::size_t j = 0; j < four.columns(); ++j) {
      old.mean[old.at(i, j)] = five.mean[five.at(i, j)];
      old.standard_error[old.at(i, j)] = five.standard_error[five.at(i, j)];
    }
  EXPECT_TRUE(test::compare(old, four).agrees(0.001));
  EXPECT_FALSE(test::compare(old, four, 4.0 / 5).agrees(0.001));
}

// The standard errors agree with the spread over seeds: pooled over the entries, the variance of 60
// independent runs against the mean squared standard error. The pooled ratio has a standard error of about
// sqrt(2 / 60 / 10) = 6 % (entries of a label are correlated; 10 labels are independent): 4 of these are
// allowed. The control, standard errors too small by 1/sqrt(2) (a ratio of 2), must fail.
TEST(Simulate, StandardErrorsAreHonest) {
  const Scene scene = test::SmallStore{}.scene();
  constexpr std::uint64_t seeds = 60;
  std::vector<Moments> means, squared_errors;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    const SignalMatrix matrix = run(scene, 640, DirectLight::sampled, seed).matrix;
    means.resize(matrix.mean.size());
    squared_errors.resize(matrix.mean.size());
    for (std::size_t e = 0; e < matrix.mean.size(); ++e) {
      means[e].add(matrix.mean[e]);
      squared_errors[e].add(std::pow(matrix.standard_error[e], 2));
    }
  }
  Moments ratio;
  for (std::size_t e = 0; e < means.size(); ++e) ratio.add(means[e].variance() / squared_errors[e].mean());
  const auto honest = [](double r) { return std::abs(r - 1) < 4 * 0.06; };
  EXPECT_TRUE(honest(ratio.mean())) << ratio.mean();
  EXPECT_FALSE(honest(2 * ratio.mean()));
}

class CancelAfter : public ProgressSink {
 public:
  CancelAfter(CancelToken& token, double fraction) : token_(token), fraction_(fraction) {}
  void report(Task, double fraction, std::string_view) override {
    if (fraction >= fraction_) token_.request();
  }

 private:
  CancelToken& token_;
  double fraction_;
};

// The kept samples give an unbiased estimate: z-test at 0.1 %, relative standard errors of 5 to 20 %. The
// control is a matrix scaled as if all batches had run.
TEST(Simulate, ReturnsItsMatrixWhenCancelled) {
  const Scene scene = test::SmallStore{}.scene();
  CancelToken token;
  CancelAfter half(token, 0.5);
  const SimulationResult result =
      simulate(scene, {EstimatorKind::uniform, 6400, DirectLight::sampled, 1}, {1, &token, &half});
  EXPECT_FALSE(result.summary.complete);
  for (const LabelRow& row : result.matrix.labels) {
    EXPECT_GE(row.batches, 2U);
    EXPECT_LT(row.batches, batch_count);
    EXPECT_EQ(row.samples, row.batches * 6400 / batch_count);
  }
  const SignalMatrix whole = run(scene, 6400, DirectLight::sampled, 2).matrix;
  EXPECT_TRUE(test::compare(result.matrix, whole).agrees(0.001));
  EXPECT_FALSE(test::compare(result.matrix, whole, 2).agrees(0.001));
}

TEST(Simulate, ReportsCancellationBeforeTheFirstResult) {
  CancelToken token;
  token.request();
  EXPECT_THROW(simulate(test::SmallStore{}.scene(), {EstimatorKind::uniform, 640, DirectLight::sampled, 1},
                        {1, &token, nullptr}),
               Interrupted);
}

}  // namespace
}  // namespace shelfbeam
