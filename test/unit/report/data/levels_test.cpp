#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "shelfbeam/math/random.hpp"
#include "shelfbeam/report/data/report_data.hpp"
#include "shelfbeam/report/text/words.hpp"

namespace shelfbeam {
namespace {

// Whether every label occurs once, each level is within the band, levels are separate, and no level could
// include the first label of the next.
bool are_levels(const std::vector<ShelfLevel>& levels, const std::vector<double>& heights) {
  std::set<LabelId> seen;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const ShelfLevel& level = levels[k];
    if (level.labels.empty() || level.high - level.low > level_band + 1e-9) return false;
    if (k > 0 && level.low <= levels[k - 1].low + level_band + 1e-9) return false;
    double low = 1e9, high = -1e9;
    for (const std::uint32_t label : level.labels) {
      if (!seen.insert(label).second) return false;
      low = std::min(low, heights[label]);
      high = std::max(high, heights[label]);
    }
    if (low != level.low || high != level.high) return false;
  }
  return seen.size() == heights.size();
}

TEST(Levels, JoinsNeighbouringHeights) {
  const std::vector<double> heights{1.6, 0.4, 0.85, 1.0, 0.4, 1.1, 0.65};
  const auto levels = shelf_levels(heights);
  ASSERT_EQ(levels.size(), 3U);
  EXPECT_EQ(levels[0].labels, (std::vector<LabelId>{1, 4, 6}));  // 0.40 to 0.65: exactly the band
  EXPECT_EQ(levels[1].labels, (std::vector<LabelId>{2, 3, 5}));
  EXPECT_EQ(levels[2].labels, (std::vector<LabelId>{0}));
  EXPECT_EQ(levels[1].heights(english()), "labels at 0.85 to 1.10\u00A0m");
  EXPECT_EQ(levels[2].heights(english()), "labels at 1.60\u00A0m");
  EXPECT_TRUE(shelf_levels({}).empty());
}

TEST(Levels, AreValidForRandomHeightsAndTheCheckRejectsOthers) {
  for (std::uint32_t trial = 0; trial < 200; ++trial) {
    std::vector<double> heights;
    for (std::uint32_t k = 0; k < 40; ++k)
      heights.push_back(2.5 * to_uniform(philox({trial, k, 0, 0}, 1)[0]));
    auto levels = shelf_levels(heights);
    ASSERT_TRUE(are_levels(levels, heights)) << trial;
    ASSERT_GT(levels.size(), 1U);
    // Negative control: a label put one level too high.
    levels[1].labels.push_back(levels[0].labels.back());
    levels[0].labels.pop_back();
    EXPECT_FALSE(are_levels(levels, heights)) << trial;
  }
}

}  // namespace
}  // namespace shelfbeam
