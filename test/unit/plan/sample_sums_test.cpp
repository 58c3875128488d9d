// Tests independent batches and the confidence limits from them.

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/plan/refine.hpp"
#include "shelfbeam/plan/sub_scene.hpp"
#include "shelfbeam/plan/validation_estimates.hpp"
#include "shelfbeam/stats/distributions.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/plan/fresh_batches.hpp"
#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

SimulationOptions options_of(EstimatorKind estimator) {
  SimulationOptions options{estimator};
  options.direct = DirectLight::exact;
  options.samples = std::uint64_t{batch_count} * 20;
  options.seed = 5;
  return options;
}

const SumRule each = [](std::size_t, std::span<const double> signals, std::span<double> sums) {
  std::copy(signals.begin(), signals.end(), sums.begin());
};

// 64 batches, of which one causes nearly all of the spread, decide nothing: the lower limit is the analytic
// part, the upper one the limit of rare sums. Without that batch they decide.
TEST(ValidationEstimates, DecideNothingIfOneBatchDominatesTheSpread) {
  const auto sum_of = [](double largest) {
    ValidationEstimate sum;
    sum.known = 0.5;
    for (int b = 0; b < 64; ++b) sum.sampled.add(b == 20 ? largest : 1 + 0.01 * (b % 5));
    sum.hits = 64;
    return sum;
  };
  const ValidationEstimate skewed = sum_of(3), tame = sum_of(1);
  EXPECT_TRUE(skewed.is_rare());
  EXPECT_EQ(skewed.lower(0.01), 0.5);
  EXPECT_GT(skewed.rare_upper(0.01, 3, 1), 3);
  EXPECT_FALSE(tame.is_rare());
  EXPECT_GT(tame.lower(0.01), 1.5);
}

// The batches of a simulation give the same means and errors, within single precision.
TEST(ValidationEstimates, EqualThoseOfASimulation) {
  const Scene scene = test::PlanStore().scene();
  const std::size_t n = scene.transceivers.size();
  for (const EstimatorKind estimator : {EstimatorKind::uniform, EstimatorKind::reuse}) {
    const SimulationOptions options = options_of(estimator);
    const SignalMatrix matrix = simulate(scene, options).matrix;
    const ValidationEstimates fresh =
        test::fresh_estimates(scene, options, matrix.labels[0].batches, n, each, {.threads = 1});
    const ValidationEstimates parallel =
        test::fresh_estimates(scene, options, matrix.labels[0].batches, n, each, {.threads = 3});
    std::size_t other_seed = 0;
    SimulationOptions other = options;
    other.seed = 6;
    const ValidationEstimates different =
        test::fresh_estimates(scene, other, matrix.labels[0].batches, n, each, {});
    for (std::size_t i = 0; i < matrix.rows(); ++i)
      for (std::size_t j = 0; j < n; ++j) {
        const ValidationEstimate& sum = fresh.of(i)[j];
        const auto mean = static_cast<double>(matrix.mean[matrix.at(i, j)]);
        EXPECT_NEAR(sum.mean(), mean, 1e-6 * mean);
        EXPECT_NEAR(sum.sampled.standard_error(), static_cast<double>(matrix.standard_error[matrix.at(i, j)]),
                    1e-5 * mean);
        EXPECT_EQ(sum.mean(), parallel.of(i)[j].mean());
        EXPECT_EQ(sum.sampled.variance(), parallel.of(i)[j].sampled.variance());
        other_seed += sum.mean() != different.of(i)[j].mean();
      }
    EXPECT_GT(other_seed, matrix.rows() * n / 2);
  }
}

// The spread of a sum is that of its batches, not that of independent parts.
TEST(ValidationEstimates, KnowTheSpreadOfSums) {
  const Scene scene = test::PlanStore().scene();
  const std::size_t n = scene.transceivers.size();
  const SumRule sum_and_double = [](std::size_t, std::span<const double> signals, std::span<double> sums) {
    sums[0] = std::accumulate(signals.begin(), signals.end(), 0.0);
    sums[1] = signals[0] + signals[0];
  };
  const SimulationOptions options = options_of(EstimatorKind::uniform);
  const ValidationEstimates sums = test::fresh_estimates(scene, options, 32, 2, sum_and_double, {});
  const ValidationEstimates parts = test::fresh_estimates(scene, options, 32, n, each, {});
  for (std::size_t i = 0; i < scene.labels.size(); ++i) {
    double mean = 0;
    for (std::size_t j = 0; j < n; ++j) mean += parts.of(i)[j].mean();
    EXPECT_NEAR(sums.of(i)[0].mean(), mean, 1e-9);
    const double one = parts.of(i)[0].sampled.standard_error();
    EXPECT_NEAR(sums.of(i)[1].sampled.standard_error(), 2 * one, 1e-9);
    if (one > 0) {
      EXPECT_GT(sums.of(i)[1].sampled.standard_error(), 1.9 * one) << "not sqrt(2) as if independent";
    }
  }
}

TEST(ValidationEstimate, LimitsAreStudents) {
  ValidationEstimate sum;
  sum.known = 3;
  for (const double value : {1.0, 2.0, 3.0, 4.0}) sum.sampled.add(value), ++sum.hits;
  // Without skewness. t of 3 degrees of freedom exceeds 2.3534 with a probability of 5 %; the error is sqrt(5
  // / 3 / 4).
  const double half = 2.353363 * std::sqrt(5.0 / 12);
  EXPECT_NEAR(sum.upper(0.05), 5.5 + half, 1e-5);
  EXPECT_NEAR(sum.lower(0.05), 5.5 - half, 1e-5);
  EXPECT_FALSE(sum.is_rare()) << "hit every time";
  for (int k = 0; k < 50; ++k) sum.sampled.add(0);
  EXPECT_TRUE(sum.is_rare());
}

// Means of 64 exponential values (skewness 2): the upper limit may be too low with a probability of 1e-4, so
// 4 are expected of 40,000, and 20 have a probability below 1e-7. The control, Student's limit, fails about
// 20 times too often. The lower limit of the mirrored values is equally far off.
TEST(ValidationEstimate, LimitsHoldForSkewedBatches) {
  std::mt19937_64 random(8);
  std::exponential_distribution<double> draw(1);
  constexpr double level = 1e-4;
  const double t = -student_quantile(level, 63);
  int wrong = 0, of_student = 0;
  for (int k = 0; k < 40000; ++k) {
    ValidationEstimate sum, mirrored;
    sum.hits = mirrored.hits = 64;
    for (int b = 0; b < 64; ++b) {
      const double value = draw(random);
      sum.sampled.add(value);
      mirrored.sampled.add(-value);
    }
    wrong += sum.upper(level) < 1;
    of_student += sum.mean() + t * sum.sampled.standard_error() < 1;
    if (sum.is_rare()) continue;
    ASSERT_NEAR(mirrored.lower(level), -sum.upper(level), 1e-12);
    ASSERT_NEAR(sum.lower(level), sum.mean() - t * sum.sampled.standard_error(), 1e-12)
        << "skewness to the other side brings no limit nearer";
  }
  EXPECT_LE(wrong, 20);
  EXPECT_GT(of_student, 40);
}

// Without any hit in B batches, the probability of a hit is below 1 - level^(1/B).
TEST(ValidationEstimate, LimitsZeroHits) {
  ValidationEstimate sum;
  for (int k = 0; k < 64; ++k) sum.sampled.add(0);
  EXPECT_NEAR(success_probability_upper_limit(0, 64, 1e-3), 1 - std::pow(1e-3, 1.0 / 64), 1e-12);
  EXPECT_NEAR(sum.rare_upper(1e-3, 2.0, 0.1), 2 * (1 - std::pow(1e-3, 1.0 / 64)), 1e-12);
  EXPECT_NEAR(sum.rare_upper(1e-3, 0, 0.1), 0.4 * (1 - std::pow(1e-3, 1.0 / 64)), 1e-12)
      << "where nothing was ever hit, a hit may still give several requirements";
  EXPECT_EQ(sum.upper(1e-3), 0) << "Student's limit says nothing here";
  EXPECT_EQ(success_probability_upper_limit(64, 64, 0.01), 1);
  // With p at the limit, at most 3 of 20 have a probability of `level`: 0.05 at 0.3438 (tables).
  EXPECT_NEAR(success_probability_upper_limit(3, 20, 0.05), 0.34366, 1e-4);
}

TEST(SubScene, KeepsTheSignals) {
  const Scene scene = test::PlanStore().scene();
  const Scene part = sub_scene(scene, std::vector<LabelId>{4, 1}, std::vector<ColumnId>{7, 2, 9});
  ASSERT_EQ(part.labels.size(), 2U);
  EXPECT_EQ(part.labels[0].id, scene.labels[4].id);
  EXPECT_EQ(part.transceivers[2].id, scene.transceivers[9].id);
  SimulationOptions options = options_of(EstimatorKind::reuse);
  options.samples = 8192;
  const SignalMatrix whole = simulate(scene, options).matrix;
  options.seed = 9;
  const SignalMatrix some = simulate(part, options).matrix;
  const std::uint32_t rows[] = {4, 1}, columns[] = {7, 2, 9};
  int swapped = 0;
  // Seven times the errors of both: a probability of 1e-11 for each of six.
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = whole.at(rows[i], columns[j]), b = some.at(i, j);
      const double error = std::hypot(whole.standard_error[a], some.standard_error[b]);
      EXPECT_NEAR(whole.mean[a], some.mean[b], 7 * error);
      swapped += std::abs(whole.mean[whole.at(rows[i], columns[(j + 1) % 3])] - some.mean[b]) > 7 * error;
    }
  EXPECT_GT(swapped, 3) << "the wrong column is told from the right one";
}

// Old and new batches are weighted by their samples.
TEST(Refine, JoinsBatches) {
  const Scene scene = test::PlanStore().scene();
  const SimulationOptions options = options_of(EstimatorKind::uniform);
  SignalMatrix matrix = simulate(scene, options).matrix;
  const SignalMatrix before = matrix;
  SimulationOptions afresh = options;
  afresh.seed = 77;
  for (const ValidationRow& row : test::fresh_rows(scene, {2, 5}, afresh, 64)) join(row, matrix);
  const ValidationEstimates fresh = test::fresh_estimates(sub_scene(scene, std::vector<LabelId>{2, 5}),
                                                          afresh, 64, matrix.columns(), each, {});
  EXPECT_EQ(matrix.labels[2].batches, before.labels[2].batches + 64);
  EXPECT_EQ(matrix.labels[2].samples, 3 * before.labels[2].samples);
  EXPECT_EQ(matrix.labels[3].batches, before.labels[3].batches);
  for (std::size_t j = 0; j < matrix.columns(); ++j) {
    const std::size_t at = matrix.at(5, j);
    EXPECT_NEAR(matrix.mean[at], static_cast<double>(before.mean[at]) / 3 + fresh.of(1)[j].mean() * 2 / 3,
                1e-6 * fresh.of(1)[j].mean());
    EXPECT_LT(matrix.standard_error[at], 0.9F * before.standard_error[at] + 1e-12F);
    EXPECT_EQ(matrix.mean[matrix.at(4, j)], before.mean[before.at(4, j)]);
  }
}

// The part with more samples decides, and the part with more spread: a few skewed batches do not dominate
// many others, unless the whole error is theirs.
TEST(Refine, FlagsEntriesThatTheLargerPartFlags) {
  const Scene scene = test::PlanStore().scene();
  SignalMatrix matrix = simulate(scene, options_of(EstimatorKind::uniform)).matrix;
  std::fill(matrix.flags.begin(), matrix.flags.end(), std::uint8_t{0});
  matrix.flags[matrix.at(2, 0)] = matrix.flags[matrix.at(3, 0)] = 1;
  const std::size_t n = matrix.columns();
  ValidationRow fresh{
      2, std::vector<double>(n, 1.0), std::vector<double>(n, 0.1), std::vector<std::uint8_t>(n), 64, 64};
  fresh.flags[1] = 1;
  struct Part {
    std::uint64_t samples;
    double error;
    bool keeps, gets;
  };
  for (const Part& part :
       {Part{1, 0, true, false}, Part{1, 1e9, true, true}, Part{640000, 1e9, false, true}}) {
    SignalMatrix joint = matrix;
    fresh.samples = part.samples;
    fresh.standard_error.assign(n, part.error);
    join(fresh, joint);
    for (std::size_t i = 0; i < joint.rows(); ++i)
      for (std::size_t j = 0; j < n; ++j)
        EXPECT_EQ(joint.is_flagged(joint.at(i, j)),
                  (i == 2 && ((j == 0 && part.keeps) || (j == 1 && part.gets))) || (i == 3 && j == 0))
            << part.samples << " " << i << " " << j;
  }
  matrix.flags.clear();
  join(fresh, matrix);
  EXPECT_TRUE(matrix.flags.empty());
}

TEST(Refine, FlagsFreshBatchesAsASimulation) {
  const Scene scene = test::PlanStore().scene();
  const SimulationOptions options = options_of(EstimatorKind::uniform);
  const SignalMatrix matrix = simulate(scene, options).matrix;
  const ValidationRow row = test::fresh_rows(scene, {2}, options, matrix.labels[2].batches).front();
  const auto first = matrix.flags.begin() + static_cast<std::ptrdiff_t>(matrix.at(2, 0));
  EXPECT_EQ(row.flags,
            std::vector<std::uint8_t>(first, first + static_cast<std::ptrdiff_t>(matrix.columns())));
  const auto flagged = std::count(row.flags.begin(), row.flags.end(), 1);
  EXPECT_GT(flagged, 0);
  EXPECT_LT(flagged, static_cast<std::ptrdiff_t>(matrix.columns()));
}

}  // namespace
}  // namespace shelfbeam
