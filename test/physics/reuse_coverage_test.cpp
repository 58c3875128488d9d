// Tests the standard errors of path reuse: the share of 95 % intervals from 16 batches that contain the true
// value.

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/stats/distributions.hpp"

#include "physics/reuse_matrix.hpp"
#include "unit/transport/zoo.hpp"

namespace shelfbeam::physics::reuse_coverage {
namespace {

constexpr double requirement = 0.1;
constexpr std::uint32_t batches = 16;
constexpr std::array<double, 4> classes{0.02, 0.1, 0.3, 1e9};  // shares of the requirement

// Three rows of shelves, their labels in several clusters, and a grid of 28 units.
Scene store() {
  test::ZooStore store(9.5, 9.5, 3.2, 0.7);
  store.requirement(requirement).paint("floor", 0.3).cover("floor", "floor").paint("goods", 0.5);
  for (int g = 0; g < 3; ++g)
    store.shelves(1.2, 1.5 + 2.7 * g, 7, 1.8, {0.5, 1.1}, 2, "goods",
                  {{"depth", 0.9}, {"goods", "goods"}, {"stocking", 0.7}});
  for (int x = 0; x < 7; ++x)
    for (int y = 0; y < 4; ++y) store.unit({0.8 + 1.3 * x, 0.8 + 2.6 * y, 3.1});
  return make_scene(parse_store(store.text(), "coverage", "."));
}

// The coverage of Student's intervals whose width is multiplied by `factor`.
struct Coverage {
  std::array<std::uint64_t, 3> held{}, pairs{};
  double factor = 1;

  void add(std::size_t size_class, const Moments& found, double known, double reference) {
    const double width = factor * student_quantile(0.975, batches - 1) * found.standard_error();
    ++pairs[size_class];
    if (std::abs(known + found.mean() - reference) <= width) ++held[size_class];
  }
  double share(std::size_t size_class) const {
    return static_cast<double>(held[size_class]) / static_cast<double>(pairs[size_class]);
  }
};

// Each run has 16 batches and 16 caches. From each run the test takes one entry of every cluster and size
// class, so that no two entries have points in common. The reference is the mean over all runs, whose error
// is 1/18 of that of a run and widens the distribution by 0.2 %. With at least 1,250 pairs the shares are
// known to 0.6 %. The control multiplies standard errors by 0.8, which turns 95 % intervals into 89 %
// intervals.
TEST(ReuseCoverageSlow, IntervalsHaveTheirNominalCoverage) {
  constexpr std::uint32_t seeds = 10, runs = 32;
  const Scene scene = store();
  const World world(scene);
  const std::size_t m = world.receivers.size(), n = world.emitters.size();
  const std::vector<double> known = test::analytic_direct(world);
  std::vector<std::vector<Moments>> found;
  std::vector<double> reference = known;
  std::vector<Estimator::Block> blocks;
  for (std::uint32_t seed = 0; seed < seeds; ++seed) {
    const ReuseEstimator estimator(world, seed);
    if (seed == 0)
      for (std::size_t item = 0; item < estimator.items(); ++item) blocks.push_back(estimator.block(item));
    for (std::uint32_t run = 0; run < runs; ++run) {
      found.emplace_back(m * n);
      for (std::uint32_t b = 0; b < batches; ++b) {
        const std::vector<double> batch = test::batch_of(estimator, m, n, run * batches + b);
        for (std::size_t e = 0; e < m * n; ++e) found.back()[e].add(batch[e]);
      }
      for (std::size_t e = 0; e < m * n; ++e) reference[e] += found.back()[e].mean() / (seeds * runs);
    }
  }

  Coverage right, narrow{.factor = 0.8};
  for (const Estimator::Block& block : blocks)
    for (std::size_t size_class = 0; size_class < 3; ++size_class) {
      std::vector<std::size_t> entries;
      for (const std::uint32_t i : block.rows)
        for (std::size_t j = 0; j < n; ++j)
          if (reference[i * n + j] >= classes[size_class] * requirement &&
              reference[i * n + j] < classes[size_class + 1] * requirement)
            entries.push_back(i * n + j);
      if (entries.empty()) continue;
      for (std::uint32_t run = 0; run < found.size(); ++run) {
        const auto u = philox({run, static_cast<std::uint32_t>(size_class), block.rows[0], 0}, 1);
        const std::size_t e = entries[to_index(u[0], static_cast<std::uint32_t>(entries.size()))];
        right.add(size_class, found[run][e], known[e], reference[e]);
        narrow.add(size_class, found[run][e], known[e], reference[e]);
      }
    }
  for (std::size_t size_class = 0; size_class < 3; ++size_class) {
    EXPECT_GE(right.pairs[size_class], 1250U);
    EXPECT_GT(right.share(size_class), 0.93) << "above " << classes[size_class];
    EXPECT_LT(right.share(size_class), 0.97) << "above " << classes[size_class];
    EXPECT_LT(narrow.share(size_class), 0.93) << "above " << classes[size_class];
  }
}

}  // namespace
}  // namespace shelfbeam::physics::reuse_coverage
