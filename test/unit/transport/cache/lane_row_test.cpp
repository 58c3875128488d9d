#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/transport/cache/lane_kernels.hpp"

namespace shelfbeam {
namespace {

std::vector<float> values(const LaneRow& row, std::size_t groups) {
  return {row.values(), row.values() + groups * lanes};
}

// Small integers, exact in single precision.
TEST(LaneRow, AddsUsedLanesAndResets) {
  constexpr std::size_t groups = 5;
  LaneRow row(groups), other(groups);
  row.add(3 * lanes + 2, 4);
  row.add(3 * lanes + 2, 1);
  row.add(0, 7);
  other.add(3 * lanes + 2, 2);
  other.add(4 * lanes + 15, -1);
  row.add(other, 3);

  std::vector<float> expected(groups * lanes);
  expected[0] = 7;
  expected[3 * lanes + 2] = 11;
  expected[4 * lanes + 15] = -3;
  EXPECT_EQ(values(row, groups), expected);
  std::vector<std::uint16_t> used = row.groups();
  std::sort(used.begin(), used.end());
  EXPECT_EQ(used, (std::vector<std::uint16_t>{0, 3, 4}));

  row.clear();
  EXPECT_TRUE(row.groups().empty());
  EXPECT_EQ(values(row, groups), std::vector<float>(groups * lanes));
  row.add(other, 1);
  EXPECT_EQ(values(row, groups), values(other, groups));
}

}  // namespace
}  // namespace shelfbeam
