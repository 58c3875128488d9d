// Tests properties of a batch of path reuse other than its values.

#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/reuse/reuse.hpp"

#include "physics/strategy_store.hpp"

namespace shelfbeam {
namespace {

// A store with discs and rectangles, so that light arrives directly and by way of surfaces, and with a
// mirror.
Scene store() {
  test::StrategyStore store;
  store.add_glossy();
  store.add_glass();
  store.radius = 0.3;
  store.label_size = {0.4, 0.2};
  return store.scene();
}

bool same(const BatchValues& a, const BatchValues& b) {
  if (a.values.size() != b.values.size()) return false;
  for (std::size_t k = 0; k < a.values.size(); ++k)
    if (a.values[k].entry != b.values[k].entry || a.values[k].total != b.values[k].total ||
        a.values[k].direct != b.values[k].direct)
      return false;
  return true;
}

TEST(ReuseBatch, GivesEveryEntryOnce) {
  const Scene scene = store();
  const World world(scene);
  const ReuseEstimator estimator(world, 1);
  std::vector<int> rows(scene.labels.size());
  std::size_t direct = 0;
  for (std::size_t item = 0; item < estimator.items(); ++item) {
    const Estimator::Block& block = estimator.block(item);
    for (const std::uint32_t i : block.rows) ++rows[i];
    EXPECT_EQ(block.columns.size(), world.emitters.size());
    for (std::uint32_t batch = 0; batch < 4; ++batch) {
      BatchValues values;
      ASSERT_TRUE(estimator.sample(item, batch, nullptr, values));
      std::set<std::uint32_t> entries;
      for (const BatchValues::Value& value : values.values) {
        EXPECT_LT(value.entry, block.rows.size() * block.columns.size());
        EXPECT_TRUE(entries.insert(value.entry).second) << value.entry;
        direct += value.direct > 0 ? 1 : 0;
      }
      EXPECT_GT(entries.size(), 0U);
      EXPECT_GT(values.rays, 0U);
    }
  }
  EXPECT_GT(direct, 0U);
  EXPECT_EQ(rows, std::vector<int>(scene.labels.size(), 1));
}

// Equal bit for bit, for any previous samples and any estimator with the same seed.
TEST(ReuseBatch, FollowsFromSeedItemAndBatchAlone) {
  const Scene scene = store();
  const World world(scene);
  const ReuseEstimator one(world, 1), again(world, 1), other(world, 2);
  for (std::size_t item = 0; item < one.items(); ++item) {
    BatchValues first, second, third, next, elsewhere;
    one.sample(item, 5, nullptr, first);
    again.sample((item + 1) % again.items(), 3, nullptr, next);
    again.sample(item, 5, nullptr, second);
    one.sample(item, 5, nullptr, third);
    EXPECT_TRUE(same(first, second));
    next.clear();
    one.sample(item, 6, nullptr, next);
    EXPECT_FALSE(same(first, next));
    EXPECT_TRUE(same(first, third));
    other.sample(item, 5, nullptr, elsewhere);
    EXPECT_FALSE(same(first, elsewhere));
  }
}

}  // namespace
}  // namespace shelfbeam
