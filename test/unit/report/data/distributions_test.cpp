// Tests distributions of signals, scales and colours of charts, and the levels of shelves.

#include "shelfbeam/report/data/distributions.hpp"

#include <numeric>

#include "shelfbeam/report/chart/palette.hpp"
#include "shelfbeam/report/data/scale.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

std::uint64_t total(const Bins& bins) {
  return std::accumulate(bins.counts.begin(), bins.counts.end(), bins.below + bins.above);
}

// Whether the counts are equal to those of a plain loop over all bins and values.
bool holds(const Bins& bins, const std::vector<double>& values) {
  for (std::size_t k = 0; k < bins.counts.size(); ++k) {
    std::uint64_t count = 0;
    for (const double value : values) count += value >= bins.edges[k] && value < bins.edges[k + 1] ? 1 : 0;
    if (count != bins.counts[k]) return false;
  }
  return total(bins) == values.size();
}

TEST(SignalDistributions, ExcessEqualsAPlainCount) {
  for (std::uint32_t trial = 0; trial < 50; ++trial) {
    const SignalMatrix matrix = random_matrix(60, 5, trial);
    Placement placement;
    placement.selected = {0, 2, 3};
    const Outcome outcome = outcome_of(matrix, placement);
    const ExcessDistribution excess = excess_distribution(outcome);
    std::vector<double> values;
    for (std::size_t i = 0; i < matrix.rows(); ++i) {
      double sum = 0;
      for (const std::uint32_t j : placement.selected) sum += static_cast<double>(matrix.mean[i * 5 + j]);
      values.push_back(100 * (sum - matrix.labels[i].requirement) / matrix.labels[i].requirement);
    }
    ASSERT_TRUE(holds(excess.percent, values)) << trial;
    EXPECT_EQ(excess.percent.below, 0U);
    EXPECT_LE(excess.percent.above, 1U);
    // Zero is an edge, so met and unmet labels are never in one bar.
    EXPECT_TRUE(std::any_of(excess.percent.edges.begin(), excess.percent.edges.end(),
                            [](double e) { return e == 0; }));
    // 60 values in double precision: rounding stays below 1e-12 of their size.
    EXPECT_NEAR(excess.mean, std::accumulate(values.begin(), values.end(), 0.0) / 60, 1e-9);
    // Negative control: one value moved by two bins.
    *std::min_element(values.begin(), values.end()) +=
        2 * (excess.percent.edges[1] - excess.percent.edges[0]);
    EXPECT_FALSE(holds(excess.percent, values)) << trial;
  }
}

TEST(SignalDistributions, SignalEqualsAPlainCount) {
  SignalMatrix matrix = random_matrix(40, 7, 3);
  matrix.mean[5] = 1e-20F;  // far below eight decades
  const SignalDistribution distribution = signal_distribution(matrix);
  std::vector<double> values;
  std::uint64_t zeros = 0;
  for (const float entry : matrix.mean) {
    if (entry > 0)
      values.push_back(static_cast<double>(entry));
    else
      ++zeros;
  }
  EXPECT_EQ(distribution.zeros, zeros);
  EXPECT_GT(zeros, 0U);
  EXPECT_EQ(distribution.entries, matrix.mean.size());
  EXPECT_TRUE(holds(distribution.signal, values));
  EXPECT_EQ(distribution.signal.below, 1U);
  EXPECT_EQ(distribution.signal.above, 0U);
  values.pop_back();
  EXPECT_FALSE(holds(distribution.signal, values));
  EXPECT_LE(distribution.signal.counts.size(), static_cast<std::size_t>(bins_per_decade * signal_decades));
}

TEST(SignalDistributions, OfAnEmptyMatrixAreEmpty) {
  SignalMatrix matrix = random_matrix(2, 2, 0);
  matrix.mean.assign(4, 0);
  EXPECT_TRUE(signal_distribution(matrix).signal.counts.empty());
  EXPECT_EQ(signal_distribution(matrix).zeros, 4U);
}

TEST(SamplingSummary, EqualsAPlainRecomputation) {
  const SignalMatrix matrix = random_matrix(30, 8, 4);
  const SamplingSummary summary = sampling_summary(matrix);
  std::vector<double> relative;
  std::size_t zeros = 0;
  for (std::size_t i = 0; i < 30; ++i)
    for (std::size_t j = 0; j < 8; ++j) {
      const auto mean = static_cast<double>(matrix.mean[i * 8 + j]);
      if (mean == 0) ++zeros;
      if (mean >= 0.3 * matrix.labels[i].requirement)
        relative.push_back(static_cast<double>(matrix.standard_error[i * 8 + j]) / mean);
    }
  std::sort(relative.begin(), relative.end());
  EXPECT_TRUE(summary.has_errors);
  EXPECT_EQ(summary.entries, 240U);
  EXPECT_EQ(summary.zeros, zeros);
  EXPECT_EQ(summary.relevant, relative.size());
  EXPECT_LT(relative.size(), 240U - zeros);  // the limit at 0.3 does omit some
  EXPECT_NEAR(summary.mean,
              std::accumulate(relative.begin(), relative.end(), 0.0) / static_cast<double>(relative.size()),
              1e-12);
  EXPECT_DOUBLE_EQ(summary.worst, relative.back());
  EXPECT_DOUBLE_EQ(summary.median, quantile(relative, 0.5));
  EXPECT_EQ(summary.min_samples, 1000U);
  EXPECT_EQ(summary.max_samples, 1290U);
  EXPECT_EQ(summary.min_batches, 8U);
  EXPECT_EQ(summary.max_batches, 9U);
}

TEST(SamplingSummary, AllowsMissingErrors) {
  SignalMatrix matrix = random_matrix(3, 3, 0);
  matrix.standard_error.clear();
  EXPECT_FALSE(sampling_summary(matrix).has_errors);
}

TEST(Scale, RoundsToReadableSteps) {
  EXPECT_DOUBLE_EQ(round_step(0.9), 1);
  EXPECT_DOUBLE_EQ(round_step(1.1), 2);
  EXPECT_DOUBLE_EQ(round_step(2.2), 2.5);
  EXPECT_DOUBLE_EQ(round_step(300), 500);
  EXPECT_EQ(multiples(-1, 2.1, 1), (std::vector<double>{-1, 0, 1, 2}));
  const auto edges = one_two_five(0.03, 1.5);
  ASSERT_EQ(edges.size(), 7U);
  EXPECT_DOUBLE_EQ(edges.front(), 0.02);
  EXPECT_DOUBLE_EQ(edges.back(), 2);
  EXPECT_EQ(one_two_five(1, 1), (std::vector<double>{1, 2}));
}

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

// Relative luminance of "#rrggbb" (IEC 61966-2-1).
double luminance(const std::string& colour) {
  const auto linear = [&](std::size_t at) {
    const double c = std::stoi(colour.substr(at, 2), nullptr, 16) / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  };
  return 0.2126 * linear(1) + 0.7152 * linear(3) + 0.0722 * linear(5);
}

bool grows_in_grey(const std::function<std::string(double)>& colours) {
  for (int k = 1; k <= 20; ++k)
    if (luminance(colours(k / 20.0)) <= luminance(colours((k - 1) / 20.0))) return false;
  return true;
}

TEST(Palette, SignalColoursKeepTheirOrderInGrey) {
  EXPECT_TRUE(grows_in_grey(viridis));
  EXPECT_EQ(viridis(0), "#440154");
  EXPECT_EQ(viridis(1), "#fde725");
  // Negative control: a scale from blue to red by way of green does not.
  EXPECT_FALSE(grows_in_grey([](double t) { return t < 0.4 ? "#0000ff" : t < 0.7 ? "#00ff00" : "#ff0000"; }));
}

TEST(Palette, MarginClassesAgreeWithTheRequirement) {
  EXPECT_EQ(margin_class(-20, false), 0U);
  EXPECT_EQ(margin_class(-2, false), 1U);
  EXPECT_EQ(margin_class(0, true), 2U);
  EXPECT_EQ(margin_class(-1e-9, true), 2U);   // met within the tolerance
  EXPECT_EQ(margin_class(1e-12, false), 1U);  // never displayed as met
  EXPECT_EQ(margin_class(1, true), 3U);
  EXPECT_EQ(margin_class(9.99, true), 5U);
  EXPECT_EQ(margin_class(30, true), 6U);
  EXPECT_EQ(margin_class(-INFINITY, false), 0U);
}

TEST(Palette, SignalScaleCoversTheLargestValues) {
  const SignalScale scale({0, 0.012, 0.012, 0.3}, 12);
  EXPECT_EQ(scale.edges.front(), 0.01);
  EXPECT_EQ(scale.edges.back(), 0.5);
  EXPECT_EQ(scale.class_of(0.012), 0U);
  EXPECT_EQ(scale.class_of(0.3), scale.classes() - 1);
  const SignalScale wide({1e-9, 1e-9, 1}, 6);
  EXPECT_EQ(wide.classes(), 6U);
  EXPECT_EQ(wide.class_of(1e-9), 0U);
  EXPECT_EQ(wide.class_of(1), 5U);
  std::vector<double> mostly_strong(99, 1.5);
  mostly_strong.push_back(1e-6);
  EXPECT_EQ(SignalScale(mostly_strong, 12).edges, (std::vector<double>{1, 2}));
  EXPECT_EQ(SignalScale({0, 0}, 6).classes(), 1U);
}

}  // namespace
}  // namespace shelfbeam::test
