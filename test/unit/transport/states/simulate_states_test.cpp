#include "shelfbeam/transport/states/simulate_states.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/stats/moments.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/scene/sample_store.hpp"

namespace shelfbeam {
namespace {

// Shelves, people, and units whose power varies.
Store shop() {
  return test::read_text(R"({
    "room": {"size": [8, 6, 3], "floor": "grey", "ceiling": "grey", "walls": "grey"},
    "materials": {"grey": {"type": "lambertian", "reflectance": 0.6}, "dark": {"type": "lambertian", "reflectance": 0.2}},
    "label_types": {"l": {"threshold": 0.01}},
    "transceiver_types": {"t": {"emission": {"type": "lambertian", "flux": 3}}},
    "fixtures": [
      {"type": "gondola", "id": "A", "at": [2, 1.5], "length": 3, "depth": 0.9, "height": 1.8, "material": "grey",
       "goods": "dark", "shelves": [0.4, 0.9, 1.3], "labels": {"type": "l", "count": 3}},
      {"type": "gondola", "id": "B", "at": [2, 4], "length": 3, "depth": 0.9, "height": 1.8, "material": "grey",
       "goods": "dark", "shelves": [0.4, 0.9, 1.3]}],
    "transceivers": {"areas": [{"type": "t", "area": "room", "spacing": 2, "below_ceiling": 0.05}]},
    "variation": {"stocking": {"uniform": [0.2, 1]}, "unit_power_db": 1, "label_sensitivity_db": 1,
      "mounting": {"position": 0.05, "tilt_deg": 3},
      "people": [{"area": "room", "number": 4, "size": [0.5, 0.3, 1.75], "material": "dark"}]}})");
}

SignalMatrix states_of(const Store& store, std::uint32_t count, std::uint32_t batches, unsigned threads = 0) {
  RunControl control;
  control.threads = threads;
  return simulate_states(store, make_scene(store), {}, {.first = 0, .count = count, .batches = batches},
                         control);
}

TEST(SimulateStates, IsTheSameForAnyNumberOfThreads) {
  const Store store = shop();
  const SignalMatrix one = states_of(store, 3, 4, 1);
  EXPECT_EQ(states_of(store, 3, 4, 2), one);
  EXPECT_EQ(one.by_state.size(), 3U);
  // A state does not depend on the others.
  SignalMatrix last;
  const Scene scene = make_scene(store);
  last = simulate_states(store, scene, {}, {.first = 2, .count = 1, .batches = 4});
  EXPECT_EQ(last.by_state.front(), one.by_state.back());
}

// Sums over all entries of a label in one state, against an ordinary simulation of the exported state. 54
// sums with errors from 16 batches; at 6 standard errors, a correct program fails with a probability below
// 1e-3.
TEST(SimulateStates, AgreesWithTheExportedState) {
  const Store store = shop();
  const Scene scene = make_scene(store);
  const StoreStates states(store, scene, 1);
  SimulationOptions options;
  options.samples = 40000;
  const SignalMatrix found = states_of(store, 3, 16);
  const auto largest_z = [&](std::uint32_t exported, std::size_t layer) {
    const Scene state = make_scene(states.state(exported));
    const SignalMatrix precise = simulate(state, options).matrix;
    double largest = 0;
    for (std::size_t i = 0; i < precise.rows(); ++i) {
      double difference = 0, variance = 0;
      for (std::size_t j = 0; j < precise.columns(); ++j) {
        const std::size_t e = precise.at(i, j);
        const double factor = state.labels[i].relative_sensitivity;
        difference += static_cast<double>(found.by_state[layer].mean[e]) -
                      factor * static_cast<double>(precise.mean[e]);
        variance += std::pow(static_cast<double>(found.by_state[layer].standard_error[e]), 2) +
                    std::pow(factor * static_cast<double>(precise.standard_error[e]), 2);
      }
      largest = std::max(largest, std::abs(difference) / std::sqrt(variance));
    }
    return largest;
  };
  for (std::uint32_t k = 0; k < 3; ++k) EXPECT_LT(largest_z(k, k), 6) << k;
  EXPECT_GT(largest_z(3, 0), 6) << "the control: another state";
}

TEST(SimulateStates, MeanIsThatOfTheStates) {
  const SignalMatrix matrix = states_of(shop(), 5, 2);
  for (std::size_t e = 0; e < matrix.mean.size(); e += 7) {
    Moments moments;
    for (const SignalLayer& layer : matrix.by_state) moments.add(static_cast<double>(layer.mean[e]));
    EXPECT_FLOAT_EQ(matrix.mean[e], static_cast<float>(moments.mean()));
    EXPECT_FLOAT_EQ(matrix.standard_error[e], static_cast<float>(moments.standard_error()));
  }
}

// Power is linear in every part of the light, and sensitivity divides the requirement.
TEST(SimulateStates, PowerAndSensitivityScale) {
  Store store = shop();
  store.variation.reset();
  const Scene plain = make_scene(store);
  Scene changed = plain;
  changed.store_hash.clear();
  changed.transceivers[1].relative_power = 2;
  changed.labels[3].relative_sensitivity = 1.25;
  SimulationOptions options;
  options.estimator = EstimatorKind::uniform;
  options.samples = 320;
  const SignalMatrix before = simulate(plain, options).matrix, after = simulate(changed, options).matrix;
  for (std::size_t i = 0; i < before.rows(); ++i) {
    for (std::size_t j = 0; j < before.columns(); ++j)
      EXPECT_FLOAT_EQ(after.mean[after.at(i, j)], (j == 1 ? 2 : 1) * before.mean[before.at(i, j)]);
    EXPECT_DOUBLE_EQ(after.labels[i].requirement, before.labels[i].requirement / (i == 3 ? 1.25 : 1));
  }
  options.estimator = EstimatorKind::reuse;
  options.samples = 4000;
  const SignalMatrix weak = simulate(plain, options).matrix, strong = simulate(changed, options).matrix;
  double sum = 0, doubled = 0;
  for (std::size_t i = 0; i < weak.rows(); ++i) {
    sum += static_cast<double>(weak.mean[weak.at(i, 1)]);
    doubled += static_cast<double>(strong.mean[strong.at(i, 1)]);
  }
  EXPECT_NEAR(doubled / sum, 2, 0.02);
}

}  // namespace
}  // namespace shelfbeam
