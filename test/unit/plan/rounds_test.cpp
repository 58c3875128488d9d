#include "shelfbeam/plan/rounds.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

// If one of the labels with the smallest planned margins is far too weak, the others wait for the next round,
// unless no other selection can follow.
TEST(LabelRounds, BeginWithTheRiskiestLabels) {
  test::PlanStore store;
  store.spacing = 0.025;
  SimulationOptions options{EstimatorKind::reuse};
  options.samples = 500;
  const SignalMatrix matrix = simulate(store.scene(), options).matrix;
  const std::vector<std::uint32_t> selected{1, 7};
  std::vector<float> planned;
  std::vector<double> sums;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    for (const std::uint32_t j : selected) planned.push_back(matrix.mean[matrix.at(i, j)]);
    sums.push_back(static_cast<double>(planned.rbegin()[0]) + static_cast<double>(planned.rbegin()[1]));
  }
  ASSERT_GT(matrix.rows(), LabelRounds::riskiest_labels + 100);
  store.threshold = 1.5 * *std::min_element(sums.begin(), sums.end());
  const Scene scene = store.scene();
  for (const bool is_final : {false, true}) {
    std::vector<LabelVerdict> labels(scene.labels.size(), {.requirement = store.threshold});
    LabelRounds verdicts(scene, options, labels);
    verdicts.select({}, selected, planned, is_final);
    Rounds rounds(0.99, {.samples = 8'000'000}, options.seed);
    rounds.next();
    EXPECT_EQ(verdicts.verify(rounds, rounds.level(2), {}),
              is_final ? labels.size() : LabelRounds::riskiest_labels);
    double largest_verified = 0, smallest_left = 1e9;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      double& extreme = labels[i].samples > 0 ? largest_verified : smallest_left;
      extreme = labels[i].samples > 0 ? std::max(extreme, sums[i]) : std::min(extreme, sums[i]);
    }
    EXPECT_LE(largest_verified, is_final ? 1e9 : smallest_left);
    EXPECT_FALSE(verdicts.doubtful_labels().empty());
    rounds.next();
    verdicts.verify(rounds, rounds.level(2), {});
    for (const LabelVerdict& label : labels) EXPECT_GT(label.samples, 0U);
  }
}

}  // namespace
}  // namespace shelfbeam
