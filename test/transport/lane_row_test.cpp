#include "shelfbeam/transport/lane_row.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

std::vector<float> values(const LaneRow& row, std::size_t groups) {
  return {row.values(), row.values() + groups * lanes};
}

// Small whole numbers, exact in single precision.
TEST(LaneRow, AddsOnlyWhatIsUsedAndForgetsItAll) {
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

TEST(LaneRow, ListedGroupsTakeRowsOfAList) {
  constexpr std::size_t groups = 4;
  LaneRow row(groups);
  const std::vector<std::uint16_t> list{1, 3};
  std::vector<float> rows(2 * lanes), expected(groups * lanes);
  for (std::size_t k = 0; k < lanes; ++k) {
    rows[k] = static_cast<float>(k);
    rows[lanes + k] = 100;
    expected[lanes + k] = -2 * static_cast<float>(k);
    expected[3 * lanes + k] = -200;
  }
  row.use(list.data(), list.size());
  LaneKernels::add_listed(list.data(), list.size(), -2, rows.data(), row.mutable_values());
  EXPECT_EQ(values(row, groups), expected);
  EXPECT_EQ(row.groups(), list);
}

}  // namespace
}  // namespace shelfbeam
