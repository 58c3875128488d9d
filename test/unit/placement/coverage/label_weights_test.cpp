#include "shelfbeam/placement/coverage/label_weights.hpp"

#include <gtest/gtest.h>

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

TEST(LabelWeights, AreWholeIfTheyHaveFewDecimals) {
  SignalTable table = test::make_table({{1}, {1}, {1}}, 1);
  for (auto& label : table.labels) label.weight = 0.1;
  const detail::LabelWeights tenths(table);
  EXPECT_TRUE(tenths.are_whole());
  EXPECT_EQ(tenths.total(), 3);
  EXPECT_EQ(tenths.in_table(tenths.total()), 0.3);
  EXPECT_EQ(tenths.rounded_down(2.9), 2);
  EXPECT_EQ(tenths.rounded_up(1.1), 2);
  table.labels[0].weight = 1.0 / 3;
  const detail::LabelWeights thirds(table);
  EXPECT_FALSE(thirds.are_whole());
  EXPECT_NEAR(thirds.rounded_down(0.4), 0.4, 1e-8);
  EXPECT_GE(thirds.rounded_down(0.4), 0.4);
}

}  // namespace
}  // namespace shelfbeam
