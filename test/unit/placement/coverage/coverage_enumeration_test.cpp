#include "shelfbeam/placement/coverage/coverage_enumeration.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/coverage/weighed_tables.hpp"

namespace shelfbeam {
namespace {

using detail::EnumerationAim;
using test::are_equal;
using test::BruteForce;
using test::installed;
using test::some_units;
using test::weighed_tables;
using test::weight_of;

constexpr std::size_t ample_work = 1'000'000'000;

/// A result, and the work that it took.
struct Enumerated : detail::CoverageEnumeration {
  std::size_t work = 0;
};
Enumerated enumerate(const SignalTable& table, const PlacementProblem& problem, std::size_t units,
                     double needed, EnumerationAim aim, std::size_t max_work = ample_work) {
  const detail::LabelWeights weights(table);
  const detail::Instance instance(table, problem);
  detail::CoverageTable dense(instance, weights);
  detail::Effort left{max_work};
  Enumerated result;
  static_cast<detail::CoverageEnumeration&>(result) =
      enumerate_coverage(dense, weights, units, needed, aim, left, {});
  result.work = max_work - left.steps;
  return result;
}

// The best selection, a selection of a weight that exists, and none of a larger weight.
TEST(CoverageEnumeration, EqualsBruteForce) {
  test::RandomTables tables(91, weighed_tables);
  int improved = 0;
  for (int k = 0; k < 1500 && !HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = tables.next();
    const PlacementProblem problem = tables.next_problem();
    const std::size_t units = some_units(tables, table);
    const BruteForce::Weight best = BruteForce::weights(table, problem)[units].value();
    const detail::LabelWeights weights(table);
    const auto found = enumerate(table, problem, units, 0, EnumerationAim::best);
    ASSERT_TRUE(found.is_complete && found.selected);
    EXPECT_LE(found.selected->size(), units);
    EXPECT_TRUE(are_equal(weights.in_table(found.weight), best.reached));
    EXPECT_TRUE(are_equal(weight_of(table, problem, *found.selected), best.reached));
    const double value = found.weight * (1 - 1e-12);
    const auto same = enumerate(table, problem, units, value, EnumerationAim::first);
    EXPECT_TRUE(same.is_complete && same.selected);
    const auto more =
        enumerate(table, problem, units, found.weight + 2 * weights.step(), EnumerationAim::best);
    EXPECT_TRUE(more.is_complete);
    EXPECT_TRUE(!more.selected || weights.total() == 0);
    improved += units > installed(table) && best.reached > 0;
  }
  EXPECT_GT(improved, 500);
}

/// The largest weight of all selections of at most three units, each examined by the checker.
double best_of_three(const SignalTable& table, const PlacementProblem& problem) {
  double best = 0;
  const auto n = static_cast<std::uint32_t>(table.columns());
  const auto examine = [&](Selection selected) {
    const Check check = check_selection(table, problem, selected);
    double weight = 0;
    for (const auto& label : table.labels) weight += label.weight;
    for (const std::uint32_t i : check.unmet) weight -= table.labels[i].weight;
    if (check.allowed()) best = std::max(best, weight);
  };
  for (std::uint32_t a = 0; a < n; ++a)
    for (std::uint32_t b = a; b < n; ++b)
      for (std::uint32_t c = b; c < n; ++c) examine({a, b, c});
  return best;
}

// Tables with more labels than a vector has lanes, on which bounds exclude most of the tree.
TEST(CoverageEnumeration, EqualsTheCheckerOnLargerTables) {
  test::RandomTables random(96);
  std::size_t work = 0;
  for (int k = 0; k < 48; ++k) {
    SignalTable table = test::scattered_table(random, 50, 24, random.real(0.005, 0.05));
    if (k % 3 == 1) table.mounts = {{0, 1, 2, 3}, {10, 11}, {20, 22, 23}};
    if (k % 3 == 2) table.conflicts = {{0, 5}, {1, 2}, {3, 23}, {7, 11}};
    if (k % 2 == 0)
      for (auto& label : table.labels) label.weight = random.whole(0, 9);
    const PlacementProblem problem{
        .model = k % 4 < 2 ? CommunicationModel::cooperative : CommunicationModel::non_cooperative,
        .redundant = k % 8 < 4};
    const auto found = enumerate(table, problem, 3, 0, EnumerationAim::best);
    ASSERT_TRUE(found.is_complete && found.selected);
    ASSERT_EQ(found.weight, best_of_three(table, problem)) << k;
    work += found.work;
  }
  constexpr std::size_t selections = 2024, cells = 64;
  EXPECT_LT(work, 48 * selections * cells) << "bounds exclude selections";
}

// Too little work proves nothing, and the same work gives the same result.
TEST(CoverageEnumeration, EndsAtItsLimit) {
  const SignalTable table = test::dense_table(60, 40);
  std::size_t before = 0;
  for (const std::size_t work : {std::size_t{0}, std::size_t{100'000}, std::size_t{1'000'000}}) {
    const auto once = enumerate(table, {}, 7, 20, EnumerationAim::best, work);
    const auto again = enumerate(table, {}, 7, 20, EnumerationAim::best, work);
    EXPECT_FALSE(once.is_complete);
    EXPECT_EQ(once.selected, again.selected);
    EXPECT_EQ(once.work, again.work);
    EXPECT_GE(once.work, before);
    before = once.work;
  }
  EXPECT_TRUE(enumerate(table, {}, 1, 0, EnumerationAim::best, 0).is_complete) << "one unit needs no limit";
  EXPECT_FALSE(enumerate(table, {}, 30, 0, EnumerationAim::best).is_complete);
}

}  // namespace
}  // namespace shelfbeam
