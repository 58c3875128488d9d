#include "shelfbeam/plan/rounds.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/plan/certify.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/plan/plan_store.hpp"

namespace shelfbeam {
namespace {

// If one of the labels with the smallest planned margins is far too weak, the others wait for the next round,
// unless no other selection can follow.
TEST(LabelRoundsSlow, BeginWithTheRiskiestLabels) {
  test::PlanStore store;
  store.spacing = 0.025;
  SimulationOptions options{EstimatorKind::reuse};
  options.samples = 500;
  const SignalMatrix matrix = simulate(store.scene(), options).matrix;
  const Selection selected{1, 7};
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
    const RunControl control;
    Rounds rounds(0.99, 2, {.samples = 8'000'000}, options.seed, control);
    rounds.next();
    EXPECT_EQ(verdicts.verify(rounds), is_final ? labels.size() : LabelRounds::riskiest_labels);
    double largest_verified = 0, smallest_left = 1e9;
    for (std::size_t i = 0; i < labels.size(); ++i) {
      double& extreme = labels[i].samples > 0 ? largest_verified : smallest_left;
      extreme = labels[i].samples > 0 ? std::max(extreme, sums[i]) : std::min(extreme, sums[i]);
    }
    EXPECT_LE(largest_verified, is_final ? 1e9 : smallest_left);
    EXPECT_FALSE(verdicts.undecided_labels().empty());
    rounds.next();
    verdicts.verify(rounds);
    for (const LabelVerdict& label : labels) EXPECT_GT(label.samples, 0U);
  }
}

// The margin of the best two units is near zero, which the budget cannot decide. The matrix is 4 % too low
// and asks for three, which are verified at once. If new samples then suggest two, the plan returns to the
// three.
TEST(RoundsSlow, EndWithASelectionThatReachesAllLabels) {
  test::PlanStore store;
  SimulationOptions simulation{EstimatorKind::reuse};
  simulation.seed = 1234567;
  simulation.relative_error = RelativeError{0.002, 0.02, std::uint64_t{1} << 36};
  const SignalMatrix truth = simulate(store.scene(), simulation).matrix;
  store.threshold = test::best_pair(truth).min_signal / 1.001;
  const Scene scene = store.scene();
  const TableRule rule = [](const SignalMatrix& matrix) { return make_signal_table(matrix); };
  CertifyOptions options;
  options.budget.samples = 400'000;
  options.place.step_limit = 1 << 20;
  options.simulation.samples = 2000;
  int returned = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    options.simulation.seed = seed;
    SignalMatrix matrix = simulate(scene, options.simulation).matrix;
    for (float& mean : matrix.mean) mean *= 0.96F;
    const std::vector<float> before = matrix.mean;
    Placement first = place(rule(matrix), {}, options.place);
    ASSERT_EQ(first.count(), 3U);
    const Certified certified = certify(scene, rule, options, std::move(matrix), std::move(first));
    EXPECT_TRUE(certified.certificate.all_reached()) << seed;
    EXPECT_TRUE(check_selection(rule(certified.matrix), {}, certified.placement.selected).met())
        << "the placement refers to this matrix";
    const auto& open = certified.certificate.open;
    if (!open || (open->cause != EndCause::cheaper && !open->leaves_cheaper)) continue;
    ++returned;
    EXPECT_EQ(certified.placement.count(), 3U);
    EXPECT_LT(certified.certificate.count_lower_bound, 3U);
    EXPECT_EQ(certified.matrix.mean, before) << "of the first placement";
  }
  EXPECT_GT(returned, 0);
}

}  // namespace
}  // namespace shelfbeam
