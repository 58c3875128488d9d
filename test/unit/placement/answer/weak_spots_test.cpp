#include "shelfbeam/placement/answer/weak_spots.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/placement/io/placement_file.hpp"
#include "shelfbeam/signal/constraints/stack_tables.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

SignalTable two_seasons() {
  return stack_tables({{"summer", "summer.csv", test::make_table({{2, 0, 1}, {0, 4, 1}}, 3)},
                       {"winter", "winter.csv", test::make_table({{0, 1.5, 0}, {1.25, 0, 0}}, 3)},
                       {"empty", "empty.csv", test::make_table({}, 3)}});
}

// In summer unit 2 alone suffices; winter requires the other two.
TEST(Scenarios, OnePlacementMeetsAll) {
  const SignalTable table = two_seasons();
  const Placement found = place(table, {}, {});
  EXPECT_EQ(found.selected, (Selection{0, 1}));
  const auto margins = scenario_margins(table, found);
  ASSERT_EQ(margins.size(), 3U);
  EXPECT_EQ(margins[0].smallest_margin, 2);
  EXPECT_EQ(margins[0].label, 0U);
  EXPECT_EQ(margins[1].smallest_margin, 1.25);
  EXPECT_EQ(margins[1].label, 3U);
  EXPECT_TRUE(std::isinf(margins[2].smallest_margin));
  const std::string json = placement_json(found, table);
  for (const char* part : {"\"name\": \"winter\"", "\"smallest_margin\": 1.25", "\"label\": \"winter:L1\"",
                           "\"smallest_margin\": null"})
    EXPECT_NE(json.find(part), std::string::npos) << part << json;
}

TEST(Scenarios, HaveNoMarginsWithoutASelection) {
  const SignalTable table = stack_tables(
      {{"a", "a.csv", test::make_table({{1}}, 1)}, {"b", "b.csv", test::make_table({{0.5}}, 1)}});
  const Placement found = place(table, {}, {});
  EXPECT_EQ(found.status, Status::infeasible);
  EXPECT_TRUE(scenario_margins(table, found).empty());
  EXPECT_TRUE(
      scenario_margins(test::make_table({{1}}, 1), place(test::make_table({{1}}, 1), {}, {})).empty());
}

}  // namespace
}  // namespace shelfbeam
