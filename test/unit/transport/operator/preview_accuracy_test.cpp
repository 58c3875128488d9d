// Previews against simulations of the same units, in rooms with all kinds of surfaces, units and labels.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/operator/light_operator.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/transport/zoo.hpp"

namespace shelfbeam {
namespace {

// Shares of the signals: in doubt, and of the others those within 1.96 errors of preview and simulation
// together; for previews times `factor`, too.
struct Accuracy {
  double doubtful = 0, inside = 0, inside_if_wrong = 0;
};

Accuracy accuracy_in(const Scene& scene, std::uint64_t samples, std::uint64_t operators = 1,
                     double factor = 1.15) {
  const World world(scene);
  SimulationOptions options;
  options.samples = samples;
  options.direct = DirectLight::exact;
  const SignalMatrix truth = simulate(scene, options).matrix;
  double count = 0, sure = 0;
  Accuracy found;
  std::vector<std::unique_ptr<const LightOperator>> lights;
  for (std::uint64_t seed = 1; seed <= operators; ++seed)
    lights.push_back(std::make_unique<const LightOperator>(world, seed));
  for (std::size_t k = 0; k < operators * scene.transceivers.size(); ++k) {
    const std::size_t j = k % scene.transceivers.size();
    const Preview preview = lights[k / scene.transceivers.size()]->column(scene.transceivers[j]);
    for (std::size_t i = 0; i < scene.labels.size(); ++i) {
      const std::size_t e = i * truth.columns() + j;
      const auto signal = static_cast<double>(preview.signal[i]), mean = static_cast<double>(truth.mean[e]);
      const double allowed = 1.96 * std::hypot(static_cast<double>(preview.error[i]),
                                               static_cast<double>(truth.standard_error[e]));
      ++count;
      if (preview.doubts[i] != 0) {
        ++found.doubtful;
        continue;
      }
      ++sure;
      if (std::abs(signal - mean) <= allowed) ++found.inside;
      if (std::abs(factor * signal - mean) <= allowed) ++found.inside_if_wrong;
    }
  }
  found.doubtful /= count;
  found.inside /= std::max(1.0, sure);
  found.inside_if_wrong /= std::max(1.0, sure);
  return found;
}

// A room with a box four metres long in front of a wall, and labels behind it.
Scene behind_a_box(double reflectance, double gap) {
  test::ZooStore store = test::ZooStore(8, 6, 2.7, reflectance).paint("floor", 0.3).cover("floor", "floor");
  const double back = 8 - gap;
  store.box({back - 0.5, 1, 0}, {back, 5, 2}, "walls");
  for (int k = 0; k < 24; ++k) store.label({back + 0.01, 1.1 + 0.16 * k, 0.25 + 0.45 * (k % 4)}, {1, 0, 0});
  store.unit({4, 3, 2.65}).unit({2, 2, 2.65}).unit({7.5, 4.5, 2.6}).unit({4, 0.15, 2.3}, {0, 0.4, -1});
  return make_scene(parse_store(store.text(), "box", "."));
}

// Errors of one operator are common to many signals, so a room may be off by some of its 5 %.
TEST(PreviewAccuracy, StatesItsErrors) {
  for (const char* const name : {"ordinary shop", "discs", "polished floor", "labels with a size"}) {
    const Accuracy found = accuracy_in(test::zoo_room(name).scene(), 4000);
    EXPECT_EQ(found.doubtful, 0) << name;
    EXPECT_GT(found.inside, 0.9) << name;
    EXPECT_LT(found.inside_if_wrong, 0.85) << name;
  }
}

// Light arrives late behind a large fixture in a white room: after a few bounces, all labels there would be
// too dark together.
TEST(PreviewAccuracy, StatesItsErrorsBehindAFixture) {
  for (const double reflectance : {0.8, 0.92}) {
    const Accuracy found = accuracy_in(behind_a_box(reflectance, 0.8), 8000, 6);
    EXPECT_EQ(found.doubtful, 0) << reflectance;
    EXPECT_GT(found.inside, 0.85) << reflectance;
    EXPECT_LT(found.inside_if_wrong, 0.2) << reflectance;
  }
}

// So does light in a white room behind a door of a dark hall, although the room has less than 1 % of the
// surfaces.
TEST(PreviewAccuracySlow, StatesItsErrorsInAWhiteRoomOfADarkHall) {
  test::ZooStore store = test::ZooStore(60, 40, 3, 0.4);
  store.paint("white", 0.92)
      .inner_wall({57, 37}, {60, 37}, 0.3)
      .inner_wall({57, 37}, {57, 40})
      .box({57.05, 37.05, 0}, {60, 40, 0.02}, "white")
      .box({57.05, 37.05, 2.98}, {60, 40, 3}, "white")
      .box({57.05, 37.2, 0.02}, {57.07, 40, 2.98}, "white")
      .box({59.98, 37.05, 0.02}, {60, 39.98, 2.98}, "white")
      .box({57.05, 39.98, 0.02}, {60, 40, 2.98}, "white");
  for (int k = 0; k < 12; ++k) store.label({59.97, 37.4 + 0.2 * k, 0.3 + 0.5 * (k % 4)}, {-1, 0, 0});
  for (int k = 0; k < 4; ++k) store.label({3 + 12.0 * k, 0.01, 0.3 + 0.5 * (k % 4)}, {0, 1, 0});
  store.unit({58.5, 38.5, 2.9}).unit({58, 39, 2}, {-1, 0, 0});
  const Accuracy found = accuracy_in(make_scene(parse_store(store.text(), "hall", ".")), 8000, 3);
  EXPECT_GT(found.inside, 0.85);
  EXPECT_LT(found.inside_if_wrong, 0.4);
}

TEST(PreviewAccuracy, DoubtsStripsNarrowerThanItsCells) {
  const auto doubtful = [](double gap) {
    const Scene scene = behind_a_box(0.7, gap);
    const World world(scene);
    const Preview preview = LightOperator(world, 1, coarse_operator).column(scene.transceivers[0]);
    std::size_t count = 0;
    for (std::size_t i = 0; i < scene.labels.size(); ++i)
      count += preview.has_doubt(i, Doubt::narrow) ? 1 : 0;
    return count;
  };
  EXPECT_EQ(doubtful(0.1), 24U);
  EXPECT_GE(doubtful(0.4), 20U);
  EXPECT_EQ(doubtful(0.6), 0U);
}

TEST(PreviewAccuracySlow, StatesItsErrorsOrDoubts) {
  double rooms = 0, inside = 0;
  for (const test::ZooRoom& room : test::zoo()) {
    const Accuracy found = accuracy_in(room.scene(), 3000);
    if (found.doubtful > 0.5) continue;
    EXPECT_GT(found.inside, 0.7) << room.name;
    ++rooms;
    inside += found.inside;
  }
  EXPECT_GT(rooms, 20);
  EXPECT_GT(inside / rooms, 0.93);
}

TEST(PreviewAccuracy, DoubtsMirrorsGlassAndUnknownSurfaces) {
  const auto doubts_in = [](const std::string& name, std::size_t unit) {
    const Scene scene = test::zoo_room(name).scene();
    const World world(scene);
    return LightOperator(world, 1, coarse_operator).column(scene.transceivers[unit]);
  };
  EXPECT_TRUE(doubts_in("mirror floor, discs", 0).has_doubt(0, Doubt::mirrors));
  EXPECT_TRUE(doubts_in("glass doors", 0).has_doubt(0, Doubt::mirrors));
  // Far from all shelves.
  const Scene hall = test::zoo_room("hall of 500 m").scene();
  const World world(hall);
  Transceiver unit = hall.transceivers[0];
  unit.position = {30, 470, 6};
  const LightOperator light(world, 1, coarse_operator);
  EXPECT_TRUE(light.column(unit).has_doubt(0, Doubt::unexplored));
  EXPECT_FALSE(light.column(hall.transceivers[0]).has_doubt(0, Doubt::unexplored));
  EXPECT_FALSE(doubts_in("ordinary shop", 0).has_doubt(0, Doubt::mirrors));
}

}  // namespace
}  // namespace shelfbeam
