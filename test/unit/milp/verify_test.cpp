#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shelfbeam/milp/backend.hpp"
#include "shelfbeam/milp/solver.hpp"

#include "unit/milp/example_models.hpp"

namespace shelfbeam::milp {
namespace {

Termination judged(Termination claim, std::vector<double> solution, double dual) {
  return verified(test::triangle(), {}, {claim, 0, dual, std::move(solution)}).termination;
}

TEST(MilpVerify, MeasuresEveryKindOfViolation) {
  Model model;
  model.columns = {{1, 0, 2, true, {}}, {1, -1, infinity, false, {}}};
  model.rows = {{1, 4, {{0, 1.0}, {1, 1.0}}, {}}, {-infinity, 100, {{1, 10.0}}, {}}};
  using X = std::vector<double>;
  EXPECT_EQ(violation(model, X{1, 0.5}), 0);
  EXPECT_DOUBLE_EQ(violation(model, X{1.25, 0}), 0.25);    // not integer
  EXPECT_DOUBLE_EQ(violation(model, X{3, 0}), 0.5);        // above its bound of 2
  EXPECT_DOUBLE_EQ(violation(model, X{2, -1.5}), 0.5);     // below its bound, and the first row
  EXPECT_DOUBLE_EQ(violation(model, X{0, 0}), 1);          // first row
  EXPECT_NEAR(violation(model, X{0, 4.5}), 0.125, 1e-15);  // first row, relative to 4
  EXPECT_DOUBLE_EQ(violation(model, X{-8, 11}), 8);        // column bound, more than the second row (0.1)
  EXPECT_EQ(violation(model, X{1}), infinity);
  EXPECT_EQ(violation(model, X{1, std::numeric_limits<double>::quiet_NaN()}), infinity);
}

TEST(MilpVerify, AcceptsCorrectClaims) {
  const Result result = verified(test::triangle(), {}, {Termination::optimal, -7, 2, {1, 1 - 1e-9, 1e-8}});
  EXPECT_EQ(result.termination, Termination::optimal);
  EXPECT_EQ(result.primal_bound, 2);  // recomputed from the rounded solution
  EXPECT_EQ(result.solution, (std::vector<double>{1, 1, 0}));
  EXPECT_EQ(judged(Termination::limit, {1, 1, 1}, 1.5), Termination::limit);
  EXPECT_EQ(judged(Termination::limit, {}, 1.5), Termination::limit);
  EXPECT_EQ(judged(Termination::infeasible, {}, 0), Termination::infeasible);
}

TEST(MilpVerify, RejectsWrongClaims) {
  EXPECT_EQ(judged(Termination::optimal, {1, 0, 0}, 1), Termination::error);          // misses a row
  EXPECT_EQ(judged(Termination::optimal, {0.5, 0.5, 0.5}, 1.5), Termination::error);  // not integer
  EXPECT_EQ(judged(Termination::optimal, {2, 0, 1}, 3), Termination::error);          // beyond a bound
  EXPECT_EQ(judged(Termination::optimal, {1, 1}, 2), Termination::error);             // wrong length
  EXPECT_EQ(judged(Termination::optimal, {}, 2), Termination::error);                 // no solution
  EXPECT_EQ(judged(Termination::optimal, {1, 1, 1}, 2), Termination::error);          // gap of one third
  EXPECT_EQ(judged(Termination::limit, {1, 1, 0}, 2.5), Termination::error);     // bound above a solution
  EXPECT_EQ(judged(Termination::infeasible, {1, 1, 0}, 2), Termination::error);  // has a solution after all
}

TEST(MilpVerify, ScalesCostsByPowersOfTwo) {
  Model model = test::triangle();
  EXPECT_EQ(objective_scale(model.columns), 1);  // whole costs stay
  for (const double cost : {0.3, 1e-300, 1e-9, 700.5, 1e300, -1e-5}) {
    model.columns[0].cost = cost;
    model.columns[1].cost = model.columns[2].cost = 0;
    const double scaled = std::abs(cost) * objective_scale(model.columns);
    EXPECT_GE(scaled, 512);
    EXPECT_LT(scaled, 1024);
  }
  model.columns[0].cost = 0;
  EXPECT_EQ(objective_scale(model.columns), 1);
}

}  // namespace
}  // namespace shelfbeam::milp
