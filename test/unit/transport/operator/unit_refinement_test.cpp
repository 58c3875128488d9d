#include "shelfbeam/transport/operator/unit_refinement.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/run/simulate.hpp"

#include "unit/transport/zoo.hpp"

namespace shelfbeam {
namespace {

// z-scores of refined signals of all units of a room, and of the same signals 3 % too high.
struct Scores {
  double rms = 0, wrong_rms = 0;
};

// `together`: one refinement of all units instead of one for each.
Scores scores_in(const std::string& name, std::uint32_t batches, bool together = false) {
  const Scene scene = test::zoo_room(name).scene();
  const World world(scene);
  const LightOperator light(world, 1, coarse_operator);
  SimulationOptions options;
  options.samples = 40000;
  options.direct = DirectLight::exact;
  const SignalMatrix truth = simulate(scene, options).matrix;
  Scores scores;
  double count = 0;
  std::optional<UnitRefinement> refinement;
  for (std::size_t j = 0; j < scene.transceivers.size(); ++j) {
    if (!refinement || !together) {
      refinement.emplace(light, together ? scene.transceivers : std::vector{scene.transceivers[j]}, 3);
      refinement->add(batches, 0);
    }
    const std::size_t k = together ? j : 0;
    for (std::size_t i = 0; i < scene.labels.size(); ++i) {
      const std::size_t e = i * truth.columns() + j;
      const auto signal = static_cast<double>(refinement->signal(i, k)),
                 mean = static_cast<double>(truth.mean[e]);
      const double spread = std::hypot(static_cast<double>(refinement->standard_error(i, k)),
                                       static_cast<double>(truth.standard_error[e]));
      scores.rms += std::pow((signal - mean) / spread, 2);
      scores.wrong_rms += std::pow((1.03 * signal - mean) / spread, 2);
      ++count;
    }
  }
  return {std::sqrt(scores.rms / count), std::sqrt(scores.wrong_rms / count)};
}

// The scores of the labels of a cluster are correlated: 0.2 is three deviations of the root mean square of
// about a hundred independent ones.
TEST(UnitRefinementSlow, IsUnbiased) {
  for (const char* const name : {"ordinary shop", "polished floor", "back room with labels"}) {
    const Scores scores = scores_in(name, 128);
    EXPECT_NEAR(scores.rms, 1, 0.2) << name;
    EXPECT_GT(scores.wrong_rms, 1.3) << name;
  }
}

TEST(UnitRefinement, IsUnbiasedForUnitsTogether) {
  const Scores scores = scores_in("ordinary shop", 128, true);
  EXPECT_NEAR(scores.rms, 1, 0.2);
  EXPECT_GT(scores.wrong_rms, 1.3);
}

TEST(UnitRefinement, StopsWhereItIsPreciseAndIgnoresThreads) {
  const Scene scene = test::zoo_room("ordinary shop").scene();
  const World world(scene);
  const LightOperator light(world, 1, coarse_operator);
  const auto refined_with = [&](unsigned threads) {
    return with_threads(threads, [&] {
      UnitRefinement refinement(light, scene.transceivers[0], 3);
      int rounds = 0;
      while (refinement.add(8, 0.1) > 0) ++rounds;
      std::vector<float> result{static_cast<float>(rounds)};
      for (std::size_t i = 0; i < scene.labels.size(); ++i) {
        EXPECT_LE(static_cast<double>(refinement.standard_error(i)),
                  0.1 * scene.requirement_of(scene.labels[i]));
        result.push_back(refinement.signal(i));
      }
      return result;
    });
  };
  EXPECT_EQ(refined_with(1), refined_with(2));
}

}  // namespace
}  // namespace shelfbeam
