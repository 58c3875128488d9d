#include "shelfbeam/scene/build/blocks.hpp"

#include "support/testing.hpp"
#include "unit/scene/store/list_store.hpp"

namespace shelfbeam::test {
namespace {

// Checks of thousands of labels beside thousands of blocks at one place would take minutes.
TEST(Blocks, EndAfterAGivenNumberOfVisits) {
  const Json store = store_with(R"([{"type": "box", "id": "B{n}", "at": [1, 1, 0],
    "size": [0.5, 0.5, 0.5], "rotation_deg": 45, "material": "steel", "repeat": {"count": 1000, "step": 0.00001}}])"_json);
  const Scene scene = scene_of(store);
  const Vec3 within{1, 1.3, 0.2}, beside{0.8, 1.02, 0.2};
  const Blocks all(scene), few(scene, 5000);
  for (int k = 0; k < 20; ++k) {
    EXPECT_TRUE(all.next(within, {0, 0, 1}));
    EXPECT_FALSE(all.contain(beside)) << "within the bounds of all blocks only";
    EXPECT_EQ(few.next(within, {0, 0, 1}).has_value(), k < 5);
    EXPECT_EQ(few.is_exhausted(), k >= 4);
  }
  EXPECT_FALSE(all.is_exhausted());
  EXPECT_TRUE(few.contain(beside)) << "so that no check reports anything";
}

}  // namespace
}  // namespace shelfbeam::test
