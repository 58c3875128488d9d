// Compares estimators that share no sampling code entry by entry in a small store of 20 labels, 4 units and 2
// shelves.

#include <cmath>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/run/simulate.hpp"

#include "physics/comparison.hpp"
#include "physics/strategy_store.hpp"
#include "support/hypothesis.hpp"

namespace shelfbeam::physics::strategy_agreement {
namespace {

SignalMatrix run(const test::StrategyStore& store, const test::Way& way, std::uint64_t samples,
                 DirectLight direct = DirectLight::sampled) {
  const std::uint64_t seed =
      10 * static_cast<std::uint64_t>(way.strategy) + (way.heuristic == Heuristic::power ? 1 : 2);
  return way.simulate(store.scene(), samples, seed, {.direct = direct});
}

double relative_error(const SignalMatrix& matrix) {
  double squares = 0;
  for (std::size_t e = 0; e < matrix.mean.size(); ++e)
    squares += std::pow(matrix.standard_error[e] / matrix.mean[e], 2);
  return std::sqrt(squares / static_cast<double>(matrix.mean.size()));
}

// Tests all 80 entries together at a level of 0.1 %.
testing::AssertionResult reconcile_bounds(const SignalMatrix& a, const SignalMatrix& b) {
  return test::compare(a, b).agrees(0.001);
}

void expect_agreement(const std::vector<SignalMatrix>& all, double largest_error) {
  for (std::size_t a = 0; a < all.size(); ++a) {
    EXPECT_LT(relative_error(all[a]), largest_error) << all[a].provenance.estimator;
    for (std::size_t b = 0; b < a; ++b)
      EXPECT_TRUE(reconcile_bounds(all[a], all[b]))
          << all[a].provenance.estimator << " against " << all[b].provenance.estimator;
  }
}

test::StrategyStore glossy() {
  test::StrategyStore store;
  store.add_glossy();
  return store;
}

// (ii): discs of 0.4 m and labels of 0.6 x 0.4 m.
test::StrategyStore glass() {
  test::StrategyStore store = glossy();
  store.add_glass();
  store.radius = 0.4;
  store.label_size = {0.6, 0.4};
  return store;
}

// Diffuse and glossy surfaces. With `effort` 1, the root mean square of the entries' relative standard errors
// is about 1 %. The controls are results in a store with coats of another index, or without paths of more
// than four bounces.
void check_glossy(double effort, double largest_error) {
  const auto samples = [&](double n) { return static_cast<std::uint64_t>(n * effort); };
  const std::vector<SignalMatrix> all{run(glossy(), test::nee, samples(120000)),
                                      run(glossy(), test::mis_power, samples(120000), DirectLight::exact),
                                      run(glossy(), test::particle, samples(90000))};
  expect_agreement(all, largest_error);

  test::StrategyStore other = glossy();
  other.set("paint", make_lambertian(0.72));
  EXPECT_FALSE(reconcile_bounds(run(other, test::particle, samples(90000)), all[0]));
  other = glossy();
  other.set("floor", make_plastic(1.5, 0.6, make_microfacets(FacetDistribution::beckmann, 0.25, 0.25)));
  EXPECT_FALSE(reconcile_bounds(run(other, test::particle, samples(90000)), all[0]));
}

// A mirror, a pane and a glass block. With `effort` 1 the errors are about 3 %. The controls are results
// without one of these.
void check_glass(double effort, double largest_error) {
  const auto samples = [&](double n) { return static_cast<std::uint64_t>(n * effort); };
  const std::vector<SignalMatrix> all{run(glass(), test::walk, samples(350000)),
                                      run(glass(), test::nee, samples(75000)),
                                      run(glass(), test::mis, samples(75000)),
                                      run(glass(), test::mis_power, samples(75000), DirectLight::exact),
                                      run(glass(), test::particle, samples(120000))};
  expect_agreement(all, largest_error);

  for (const auto& [name, material] :
       std::vector<std::pair<std::string, Material>>{{"mirror", make_lambertian(0)},
                                                     {"pane", make_thin_dielectric(1, 0, 0)},
                                                     {"glass", make_lambertian(0)}}) {
    test::StrategyStore other = glass();
    other.set(name, material);
    EXPECT_FALSE(reconcile_bounds(run(other, test::mis, samples(75000)), all[2])) << name;
  }
}

TEST(StrategyAgreementSlow, DiffuseAndGlossyToOnePercent) {
  check_glossy(0.8, 0.0125);
}
TEST(StrategyAgreementSlow, MirrorPaneAndGlassToFourPercent) {
  check_glass(0.6, 0.044);
}

}  // namespace
}  // namespace shelfbeam::physics::strategy_agreement
