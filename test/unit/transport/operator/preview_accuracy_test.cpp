// Previews against simulations of the same units, in rooms with all kinds of surfaces, units and labels.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

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

Accuracy accuracy_in(const std::string& name, std::uint64_t samples, double factor = 1.15) {
  const Scene scene = test::zoo_room(name).scene();
  const World world(scene);
  const LightOperator light(world, 1);
  SimulationOptions options;
  options.samples = samples;
  options.direct = DirectLight::exact;
  const SignalMatrix truth = simulate(scene, options).matrix;
  double count = 0, sure = 0;
  Accuracy found;
  for (std::size_t j = 0; j < scene.transceivers.size(); ++j) {
    const Preview preview = light.column(scene.transceivers[j]);
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

// Errors of one operator are common to many signals, so a room may be off by some of its 5 %.
TEST(PreviewAccuracy, StatesItsErrors) {
  for (const char* const name : {"ordinary shop", "discs", "polished floor", "labels with a size"}) {
    const Accuracy found = accuracy_in(name, 4000);
    EXPECT_EQ(found.doubtful, 0) << name;
    EXPECT_GT(found.inside, 0.9) << name;
    EXPECT_LT(found.inside_if_wrong, 0.85) << name;
  }
}

TEST(PreviewAccuracySlow, StatesItsErrorsOrDoubts) {
  double rooms = 0, inside = 0;
  for (const test::ZooRoom& room : test::zoo()) {
    const Accuracy found = accuracy_in(room.name, 3000);
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
