#include "shelfbeam/transport/run/batch_scheduler.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/transport/run/make_estimator.hpp"
#include "shelfbeam/transport/run/prepared_scene.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "support/expect_input_error.hpp"
#include "support/processor_time.hpp"
#include "support/small_store.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

SimulationOptions to_relative_error(double error) {
  SimulationOptions options{EstimatorKind::uniform};
  options.direct = DirectLight::exact;
  options.relative_error = RelativeError{error, 0.3};
  return options;
}

Precision precision(const SignalMatrix& matrix, double error) {
  Precision all;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    std::vector<double> means, errors;
    std::vector<std::uint8_t> flags;
    for (std::size_t j = 0; j < matrix.columns(); ++j) {
      means.push_back(matrix.mean[matrix.at(i, j)]);
      errors.push_back(matrix.standard_error[matrix.at(i, j)]);
      flags.push_back(matrix.flags[matrix.at(i, j)]);
    }
    all += count_precise(means, errors, flags, matrix.labels[i].requirement, {error, 0.3});
  }
  return all;
}

// Control: a tenth less was not reached.
TEST(BatchScheduler, StopsWhenTheRelativeErrorIsReached) {
  const Scene scene = test::SmallStore{}.scene();
  const SimulationResult result = simulate(scene, to_relative_error(0.02));
  EXPECT_TRUE(result.summary.complete);
  EXPECT_GT(precision(result.matrix, 0.02).relevant, 10u);
  EXPECT_TRUE(precision(result.matrix, 0.02 * (1 + 1e-6)).is_enough());
  EXPECT_FALSE(precision(result.matrix, 0.018).is_enough());
  // Labels that became precise enough before the others have paused.
  EXPECT_GE(result.summary.min_batches, min_batches);
  EXPECT_LT(result.summary.min_batches, result.summary.max_batches);
  for (const LabelRow& row : result.matrix.labels) {
    EXPECT_TRUE(is_stopping_point(row.batches));
    EXPECT_EQ(row.samples, row.batches * open_samples_per_batch);
  }
  const ErrorQuantiles& errors = result.summary.errors[0];
  EXPECT_EQ(errors.entries, precision(result.matrix, 1).relevant);
  EXPECT_LE(errors.median, errors.p90);
  EXPECT_LE(errors.p90, errors.p99);
  EXPECT_LE(errors.p99, 0.02 * 1.01);
  EXPECT_GT(result.summary.seconds_to_halve, 0);
  EXPECT_LE(result.summary.seconds_to_halve, 3 * result.summary.seconds);
}

TEST(BatchScheduler, StopsAtTheSameBatchForAnyNumberOfThreads) {
  const Scene scene = test::SmallStore{}.scene();
  for (const Strategy strategy : {Strategy::mis, Strategy::particle}) {
    SimulationOptions options = to_relative_error(strategy == Strategy::mis ? 0.04 : 0.02);
    options.strategy = strategy;
    const SignalMatrix one = simulate(scene, options, {1}).matrix;
    for (const unsigned threads : {2U, 5U}) {
      const SignalMatrix many = simulate(scene, options, {threads}).matrix;
      EXPECT_EQ(one.mean, many.mean);
      EXPECT_EQ(one.standard_error, many.standard_error);
      EXPECT_EQ(one.direct, many.direct);
      for (std::size_t i = 0; i < one.rows(); ++i) EXPECT_EQ(one.labels[i].batches, many.labels[i].batches);
    }
  }
}

// With few items, several batches run at once; the sums are those of sequential batches. The control
// exchanges two batches, which changes the rounding.
TEST(BatchScheduler, AddsBatchesInTheirOrder) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
  options.strategy = Strategy::particle;
  const auto prepared = prepare(scene, options, false);
  const Estimator* const estimator = &prepared->estimator();
  const std::uint32_t batches = batches_for(*estimator, options);
  ASSERT_LE(estimator->items(), 8U);
  const auto one_by_one = [&](std::uint32_t first, std::uint32_t second) {
    const Estimator::Block& block = estimator->block(0);
    ItemSums sums(block.rows.size() * block.columns.size(), true, 0);
    BatchValues values;
    for (std::uint32_t b = 0; b < batches; ++b) {
      values.clear();
      estimator->sample(0, b == first ? second : b == second ? first : b, nullptr, values);
      sums.add(values);
    }
    return sums.values;
  };
  const RunControl control;
  detail::BatchScheduler engine(*prepared, options, "hash", control);
  ASSERT_TRUE(engine.run());
  ASSERT_EQ(engine.sums()[0].batches, batches);
  EXPECT_EQ(engine.sums()[0].values, one_by_one(0, 0));
  EXPECT_NE(engine.sums()[0].values, one_by_one(3, 9));
}

// Values of the second label of an item and its first source.
TEST(BatchScheduler, RejectsNaN) {
  const Scene scene = test::SmallStore{}.scene();
  const Estimator::Block block{{3, 5}, {1, 2}};
  BatchValues values;
  values.values = {{0, 1, 0}, {2, 1, 1}};
  EXPECT_NO_THROW(expect_numbers(scene, block, values));
  for (const double wrong : {std::nan(""), HUGE_VAL}) {
    values.values[1] = {2, wrong, 0};
    try {
      expect_numbers(scene, block, values);
      ADD_FAILURE() << wrong;
    } catch (const std::runtime_error& error) {
      const std::string said = error.what();
      EXPECT_NE(said.find("'" + scene.labels[5].id + "'"), std::string::npos) << said;
      EXPECT_NE(said.find("'" + scene.transceivers[1].id + "'"), std::string::npos) << said;
    }
    values.values[1] = {2, 1, wrong};
    EXPECT_THROW(expect_numbers(scene, block, values), std::runtime_error);
  }
}

TEST(BatchScheduler, TakesSixteenBatchesThenStopsAtTheTimeLimit) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
  options.time_s = 1e-6;
  const SimulationSummary least = simulate(scene, options).summary;
  EXPECT_TRUE(least.complete);
  EXPECT_EQ(least.min_batches, min_batches);
  EXPECT_EQ(least.max_batches, min_batches);
  // On a machine of any load, some time suffices for more.
  for (double time_s = 0.3;; time_s *= 3) {
    options.time_s = time_s;
    const test::ProcessorTime spent;
    const SimulationSummary more = simulate(scene, options, {.threads = 1}).summary;
    EXPECT_LT(spent.seconds(), 2 * time_s + 1);
    if (more.min_batches > min_batches) break;
  }
}

// Any reason to stop after 16 batches gives the same batches.
TEST(BatchScheduler, BatchesDoNotDependOnTheStop) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions timed{EstimatorKind::uniform};
  timed.direct = DirectLight::exact;
  timed.time_s = 1e-6;
  const SignalMatrix by_time = simulate(scene, timed).matrix;
  SimulationOptions contented = to_relative_error(1);
  contented.relative_error->above = 1e6;  // no entry matters
  const SignalMatrix by_error = simulate(scene, contented).matrix;
  for (const LabelRow& row : by_error.labels) EXPECT_EQ(row.batches, min_batches);
  EXPECT_EQ(by_time.mean, by_error.mean);
  EXPECT_EQ(by_time.standard_error, by_error.standard_error);
  EXPECT_NE(by_time.mean, simulate(scene, to_relative_error(0.03)).matrix.mean);
}

// A run ends early if its error would take more than the allowed samples, and names the entries that miss it.
// With enough samples it is reached.
TEST(BatchScheduler, EndsIfTheErrorIsOutOfReach) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options = to_relative_error(1e-4);
  options.relative_error->max_samples = 20000;
  const SimulationSummary found = simulate(scene, options).summary;
  EXPECT_TRUE(found.complete);
  EXPECT_EQ(found.unmet_error, 1e-4);
  EXPECT_GE(found.min_batches, judged_batches);
  EXPECT_LT(found.max_samples, 20000U) << "it was plain before";
  ASSERT_GT(found.unmet, 0U);
  ASSERT_FALSE(found.worst_unmet.empty());
  EXPECT_GT(found.worst_unmet.front().relative_error, 1e-4);
  EXPECT_FALSE(found.worst_unmet.front().label.empty());
  EXPECT_FALSE(simulate(scene, to_relative_error(0.05)).summary.unmet_error);
}

TEST(BatchScheduler, WritesTheSameFileAsTheMatrix) {
  const test::TempFolder folder;
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
  options.samples = 320;
  options.max_bounces = 2;
  options.by_bounce = true;
  simulate_to_file(scene, options, folder / "a.h5");
  write_signal_file(simulate(scene, options).matrix, folder / "b.h5");
  EXPECT_TRUE(read_file(folder / "a.h5") == read_file(folder / "b.h5"));
  EXPECT_EQ(folder.count(), 2);
}

TEST(BatchScheduler, ReportsTheMemoryItRequires) {
  const Scene scene = test::SmallStore{}.scene();
  SimulationOptions options{EstimatorKind::uniform};
  options.samples = 64;
  options.memory = 100;
  test::expect_input_error([&] { simulate(scene, options); }, "memory: ", "1e-07 GB");
  // A sufficient limit is accepted: about 3 kB for ten labels and four units.
  options.memory = 10000;
  simulate(scene, options);
}

}  // namespace
}  // namespace shelfbeam
