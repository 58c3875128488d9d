#include "shelfbeam/scene/build/keep_out_index.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

bool is_in(const KeepOut& area, const Vec3& p) {
  return p.x >= area.min[0] && p.x <= area.max[0] && p.y >= area.min[1] && p.y <= area.max[1];
}

TEST(KeepOutIndex, FindsTheSameAreasAsASearchOfAll) {
  std::mt19937 random(1);
  const auto number = [&](int below) { return static_cast<double>(random() % static_cast<unsigned>(below)); };
  int inside = 0;
  for (const std::size_t count : {0U, 1U, 4U, 5U, 100U, 700U}) {
    std::vector<KeepOut> areas;
    while (areas.size() < count) {
      const Vec2 low{number(100), number(100)};
      // Thin strips, points and duplicates, too.
      areas.push_back({low, {low[0] + number(10) * number(2), low[1] + number(4)}});
    }
    const KeepOutIndex index(areas);
    for (int k = 0; k < 2000; ++k) {
      const Vec3 p{number(220) / 2, number(220) / 2, 3};
      const bool expected =
          std::any_of(areas.begin(), areas.end(), [&](const KeepOut& area) { return is_in(area, p); });
      EXPECT_EQ(index.contains(p), expected) << p.x << ' ' << p.y;
      inside += expected;
    }
  }
  EXPECT_GT(inside, 300);
  EXPECT_LT(inside, 9000);
}

}  // namespace
}  // namespace shelfbeam
