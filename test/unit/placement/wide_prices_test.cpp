#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/enumeration.hpp"
#include "unit/placement/random_table.hpp"

// Prices over many orders of magnitude, below the tolerances of solvers.
namespace shelfbeam {
namespace {

struct Claims {
  int optimal = 0, stopped = 0;
};

void expect_true(const Placement& found, double best, Claims& claims, double rounding = 0) {
  EXPECT_GE(found.objective_value, best - rounding);
  EXPECT_LE(found.lower_bound, best + rounding);
  if (found.status == Status::optimal) {
    ++claims.optimal;
    EXPECT_NEAR(found.objective_value, best, rounding);
  } else {
    ++claims.stopped;
  }
}

double whole_price(test::RandomTables& random) {
  return std::round(std::pow(10.0, random.real(0, 12)));
}

// Cents beside up to a thousand million, so that sums are rounded.
double price_in_cents(test::RandomTables& random) {
  const int millions = random.whole(0, 1) * random.whole(1, 100);
  return 1e7 * millions + 0.01 * random.whole(1, 9999);
}

Claims compare(const PlaceOptions& options, int cases, double (&price)(test::RandomTables&) = whole_price,
               double rounding = 0) {
  Claims claims;
  test::RandomTables random(61, {.labels = 8, .transceivers = 10, .borderline = false, .mounts = true});
  for (int k = 0; k < cases; ++k) {
    SCOPED_TRACE(k);
    SignalTable table = random.next();
    for (auto& unit : table.transceivers) unit.cost = price(random);
    const PlacementProblem problem{
        .model = random.chance(0.5) ? CommunicationModel::cooperative : CommunicationModel::non_cooperative,
        .combination = Combination::weighted};
    const test::BruteForce truth(table, problem);
    if (truth.feasible) expect_true(place(table, problem, options), truth.best_sum, claims, rounding);
  }
  return claims;
}

TEST(WidePrices, ClaimsOfTheSearchAreExact) {
  const Claims claims = compare({.step_limit = test::ample_steps}, 600);
  EXPECT_GT(claims.optimal, 200);
  EXPECT_LT(claims.stopped, claims.optimal / 20);
}

// A selection that is a cent cheaper is found.
TEST(WidePrices, CentsCount) {
  constexpr double half_a_cent = 0.005;
  const Claims claims = compare({.step_limit = test::ample_steps}, 600, price_in_cents, half_a_cent);
  EXPECT_GT(claims.optimal, 200);
}

TEST(WidePrices, SolversClaimNoMoreThanTheyProve) {
  for (const milp::Backend& backend : milp::backends()) {
    SCOPED_TRACE(backend.name);
    const Claims claims = compare(
        {.solver = SolverChoice::mip, .backend = std::string(backend.name), .step_limit = test::ample_steps},
        300);
    EXPECT_GT(claims.optimal, 50);
  }
}

// A unit of 1e12 is needed, and beside it units for 9 or for 10. Solvers do not see the difference.
TEST(WidePrices, SeeSmallPricesBesideALargeOne) {
  SignalTable table = test::make_table({{1, 0, 0, 0}, {0, 1, 1, 0}, {0, 1, 0, 1}}, 4);
  const double prices[] = {1e12, 10, 4, 5};
  for (std::size_t j = 0; j < 4; ++j) table.transceivers[j].cost = prices[j];
  for (const auto model : {CommunicationModel::non_cooperative, CommunicationModel::cooperative}) {
    const PlacementProblem problem{.model = model, .combination = Combination::weighted};
    const Placement best = place(table, problem, {});
    EXPECT_EQ(best.status, Status::optimal);
    EXPECT_EQ(best.objective_value, 1e12 + 9);
    EXPECT_EQ(best.lower_bound, 1e12 + 9);
    for (const milp::Backend& backend : milp::backends()) {
      Claims claims;
      expect_true(place(table, problem, {.solver = SolverChoice::mip, .backend = std::string(backend.name)}),
                  1e12 + 9, claims);
    }
  }
}

}  // namespace
}  // namespace shelfbeam
