#include "shelfbeam/milp/branching.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "unit/milp/every_backend.hpp"

namespace shelfbeam::milp {
namespace {

class MilpBranching : public testing::TestWithParam<Backend> {};

INSTANTIATE_TEST_SUITE_P(Every, MilpBranching, test::every_backend, test::backend_name);

/// Binary models with rows of both senses; some are infeasible, some columns fixed, some costs real.
Model random_model(std::mt19937_64& random) {
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  const auto whole = [&](int low, int high) { return std::uniform_int_distribution(low, high)(random); };
  Model model;
  const bool is_whole = whole(0, 1) == 0;
  const int columns = whole(1, 11);
  for (int j = 0; j < columns; ++j) {
    model.columns.push_back({is_whole ? whole(0, 9) : real(0, 9), 0, 1, true, {}});
    if (whole(0, 9) == 0) model.columns.back().lower = 1;
    if (whole(0, 9) == 0) model.columns.back().upper = model.columns.back().lower;
  }
  for (int i = whole(1, 12); i > 0; --i) {
    Row row;
    for (std::uint32_t j = 0; j < model.columns.size(); ++j)
      if (whole(0, 2) == 0) row.entries.push_back({j, whole(0, 1) == 0 ? 1.0 : real(0.1, 1)});
    if (whole(0, 4) == 0)
      row.upper = real(0.5, 2);
    else
      row.lower = whole(0, 1) == 0 ? 1.0 : real(0.3, 1.5);
    model.rows.push_back(std::move(row));
  }
  return model;
}

/// The minimum by enumeration; infinite without a solution. Rows are met with a margin or not at all.
struct Truth {
  double best = infinity;
  bool is_borderline = false;

  explicit Truth(const Model& model) {
    const auto count = static_cast<std::uint32_t>(model.columns.size());
    for (std::uint32_t set = 0; set < (1U << count); ++set) {
      std::vector<double> x;
      for (std::uint32_t j = 0; j < count; ++j) x.push_back((set >> j & 1U) != 0 ? 1.0 : 0.0);
      const double miss = violation(model, x);
      is_borderline = is_borderline || (miss > 0 && miss < 1e-5);
      if (miss <= 0) best = std::min(best, objective(model, x));
    }
  }
};

TEST_P(MilpBranching, EqualsEnumeration) {
  std::mt19937_64 random(5);
  int optimal = 0, infeasible = 0, cut_off = 0, kept = 0;
  for (int k = 0; k < 1500; ++k) {
    SCOPED_TRACE(k);
    const Model model = random_model(random);
    const Truth truth(model);
    if (truth.is_borderline) continue;
    const Result found = branch_and_bound(model, GetParam(), {}, {});
    if (std::isinf(truth.best)) {
      ++infeasible;
      ASSERT_EQ(found.termination, Termination::infeasible);
      continue;
    }
    ++optimal;
    ASSERT_EQ(found.termination, Termination::optimal);
    ASSERT_NEAR(found.primal_bound, truth.best, 1e-9 * (1 + truth.best));
    ASSERT_LE(found.dual_bound, truth.best * (1 + 1e-9) + 1e-9);
    EXPECT_TRUE(found.is_safe);

    // Just below the minimum there is nothing, and at the minimum there is something.
    const double step = 1e-4 * (1 + truth.best);
    const Result below = branch_and_bound(model, GetParam(), {.cutoff = truth.best - step}, {});
    ASSERT_EQ(below.termination, Termination::infeasible);
    ++cut_off;
    const Result at = branch_and_bound(model, GetParam(), {.cutoff = truth.best + step}, {});
    ASSERT_EQ(at.termination, Termination::optimal);
    ASSERT_NEAR(at.primal_bound, truth.best, 1e-9 * (1 + truth.best));
    ++kept;
  }
  EXPECT_GT(optimal, 300);
  EXPECT_GT(infeasible, 150);
  EXPECT_EQ(cut_off, kept);
}

// Prices in hundredths, of which the larger are a thousand million steps: no better solution is pruned.
TEST_P(MilpBranching, SeesAStepOfLargePrices) {
  Model model;
  for (const double cost : {2e7 + 0.01, 2e7, 1e7, 1e7 + 0.02})
    model.columns.push_back({cost, 0, 1, true, {}});
  model.rows = {{1, infinity, {{0, 1}, {1, 1}}, {}}, {1, infinity, {{2, 1}, {3, 1}}, {}}};
  const Result found = branch_and_bound(model, GetParam(), {.step = 0.01}, {});
  EXPECT_EQ(found.primal_bound, 3e7);
  EXPECT_EQ(found.dual_bound, 3e7);
  const Result without = branch_and_bound(model, GetParam(), {}, {});
  EXPECT_LE(without.dual_bound, 3e7) << "nothing is claimed without the step";
}

// Three rows, any two of which share a column: the relaxation is 1.5, the minimum 2.
Model triangle() {
  Model model;
  for (int j = 0; j < 3; ++j) model.columns.push_back({1, 0, 1, true, {}});
  model.rows = {{1, infinity, {{0, 1}, {1, 1}}, {}},
                {1, infinity, {{1, 1}, {2, 1}}, {}},
                {1, infinity, {{0, 1}, {2, 1}}, {}}};
  return model;
}

TEST_P(MilpBranching, KeepsABoundAtItsLimits) {
  const Result stopped = branch_and_bound(triangle(), GetParam(), {.node_limit = 1}, {});
  EXPECT_EQ(stopped.termination, Termination::limit);
  EXPECT_LE(stopped.dual_bound, 2);
  CancelToken cancelled;
  cancelled.request();
  const Result nothing = branch_and_bound(triangle(), GetParam(), {}, {.cancel = &cancelled});
  EXPECT_EQ(nothing.termination, Termination::interrupted);
  EXPECT_LE(nothing.dual_bound, 0);
}

TEST_P(MilpBranching, RefusesColumnsThatAreNotBinary) {
  Model model = triangle();
  model.columns[1].upper = 2;
  EXPECT_EQ(branch_and_bound(model, GetParam(), {}, {}).termination, Termination::error);
  model.columns[1] = {1, 0, 1, false, {}};
  EXPECT_EQ(branch_and_bound(model, GetParam(), {}, {}).termination, Termination::error);
}

// Any multipliers give a bound. Negative control: ignoring the right-hand sides' signs does not.
TEST(MilpSafeBound, HoldsForAnyMultipliers) {
  std::mt19937_64 random(6);
  std::uniform_real_distribution<double> size(-4, 4);
  int tight = 0, too_much = 0;
  for (int k = 0; k < 3000; ++k) {
    const Model model = random_model(random);
    const Truth truth(model);
    std::vector<double> lower, upper, y, of_the_other_side;
    for (const Column& column : model.columns) {
      lower.push_back(column.lower);
      upper.push_back(column.upper);
    }
    for (std::size_t i = 0; i < model.rows.size(); ++i) y.push_back(size(random));
    const double bound = safe_bound(model, lower, upper, y).value;
    ASSERT_LE(bound, truth.best);
    tight += bound > 0.5 * truth.best && truth.best < infinity && truth.best > 0;
    // Without the costs, only a model without a solution has a positive bound.
    if (safe_bound(model, lower, upper, y, false).value > 0) {
      ASSERT_EQ(truth.best, infinity);
    }
    Model wrong = model;
    for (Row& row : wrong.rows) std::swap(row.lower, row.upper);
    for (Row& row : wrong.rows) {
      if (row.lower == infinity) row.lower = 1;
      if (row.upper == -infinity) row.upper = 1;
    }
    too_much += truth.best < infinity && safe_bound(wrong, lower, upper, y).value > truth.best + 1e-6;
  }
  EXPECT_GT(tight, 30);
  EXPECT_GT(too_much, 30);
}

}  // namespace
}  // namespace shelfbeam::milp
