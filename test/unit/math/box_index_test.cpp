#include "shelfbeam/math/box_index.hpp"

#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

TEST(BoxIndex, FindsTheSameBoxesAsASearchOfAll) {
  std::mt19937 random(1);
  const auto number = [&](unsigned below) { return static_cast<double>(random() % below); };
  std::size_t met = 0;
  for (const std::size_t count : {0U, 1U, 4U, 5U, 100U, 700U}) {
    std::vector<Bounds> boxes;
    while (boxes.size() < count) {
      const Vec3 low{number(100), number(100), number(20)};
      // Thin strips, points and duplicates, too.
      boxes.push_back({low, low + Vec3{number(10) * number(2), number(4), number(3)}});
    }
    const BoxIndex index(boxes);
    for (int k = 0; k < 500; ++k) {
      const Vec3 p{number(220) / 2, number(220) / 2, number(44) / 2};
      const Bounds query = Bounds{p, p}.wider_by(number(6));
      std::set<std::uint32_t> expected, found;
      for (std::uint32_t i = 0; i < count; ++i)
        if (boxes[i].meets(query)) expected.insert(i);
      EXPECT_FALSE(index.any(query, [&](std::uint32_t i) {
        EXPECT_TRUE(found.insert(i).second) << "visited twice";
        return false;
      }));
      EXPECT_EQ(found, expected);
      EXPECT_EQ(index.any(query, [](std::uint32_t) { return true; }), !expected.empty());
      met += expected.size();
    }
  }
  EXPECT_GT(met, 500U);
}

}  // namespace
}  // namespace shelfbeam
