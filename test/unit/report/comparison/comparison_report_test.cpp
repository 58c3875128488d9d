#include "shelfbeam/report/comparison/comparison_report.hpp"

#include "shelfbeam/report/messages/comparison.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

/// Signals of 40 labels from 3 units. Measured values are 5 times as large, plus or minus half a decibel.
struct Survey {
  SignalMatrix matrix;
  std::vector<ComparedPair> pairs;

  Survey() {
    for (std::size_t j = 0; j < 3; ++j)
      matrix.transceivers.push_back({"T<" + std::to_string(j) + ">", "c", {}, {}});
    for (std::uint32_t i = 0; i < 40; ++i) {
      matrix.labels.push_back({"A&\"" + std::to_string(i) + "\"", "s", {}, {}});
      for (std::uint32_t j = 0; j < 3; ++j) {
        const double signal = 0.01 * std::pow(0.9, i) * std::pow(0.97, j);
        const double db = i % 2 == 0 ? 0.5 : -0.5;
        pairs.push_back({i, j, 5 * signal * std::pow(10, db / 10), 0.02 * signal, signal, 0.01 * signal});
      }
    }
    pairs[7].measured /= 20;
    pairs[11].measured = 0;
  }
};

TEST(ComparisonReport, PageContainsTheNumbers) {
  const Survey survey;
  const Comparison comparison = compare_signals(survey.pairs);
  const Page page(comparison_html(english(), {survey.matrix, survey.pairs, comparison, "m<1>.csv", "s.h5"}));
  EXPECT_THAT(
      missing_in(page.text, {"m<1>.csv compared with s.h5", english().significant(comparison.factor, 4),
                             english().significant(comparison.factor_interval.low, 4),
                             english().fixed(comparison.residual_quantile_90, 2), "2 outliers", "A&\"2\"",
                             "T<1>", "1 pair without a positive signal on both sides is not drawn"}),
      testing::IsEmpty());
  EXPECT_THAT(missing_in(page.text, comparison_statements(english(), comparison)), testing::IsEmpty());
  EXPECT_FALSE(page.has_text("3 outliers")) << "negative control";
  EXPECT_EQ(count_of("<use href=\"#s", page.html), survey.pairs.size() - 1) << "one a pair with a residual";
}

TEST(ComparisonReport, OverlappingDotsAreDrawnOnce) {
  Survey survey;
  const auto size_of = [&](const std::vector<ComparedPair>& pairs) {
    return comparison_html(english(), {survey.matrix, pairs, compare_signals(pairs), "m", "s"}).size();
  };
  std::vector<ComparedPair> many;
  for (int copy = 0; copy < 300; ++copy)
    many.insert(many.end(), survey.pairs.begin(), survey.pairs.begin() + 6);
  EXPECT_LT(size_of(many), size_of(survey.pairs));
}

TEST(ComparisonReport, TableHasOneRowPerPair) {
  const Survey survey;
  const Comparison comparison = compare_signals(survey.pairs);
  const auto rows = read_csv(comparison_csv({survey.matrix, survey.pairs, comparison, "m", "s"}));
  ASSERT_EQ(rows.size(), survey.pairs.size() + 1);
  for (std::size_t k = 0; k < survey.pairs.size(); ++k) {
    const auto& row = rows[k + 1];
    const ComparedPair& pair = survey.pairs[k];
    const PairResult& result = comparison.pairs[k];
    EXPECT_EQ(row[0], survey.matrix.labels[pair.label].id);
    EXPECT_EQ(row[1], survey.matrix.transceivers[*pair.transceiver].id);
    EXPECT_NEAR(std::stod(row[6]) * comparison.factor, pair.measured, 1e-8 * (pair.measured + 1e-9));
    EXPECT_EQ(row[7].empty(), !result.residual.has_value());
    if (result.residual) {
      EXPECT_NEAR(std::stod(row[7]), 10 * std::log10(pair.measured / result.expected), 1e-7);
    }
    EXPECT_EQ(row[9], k == 11 ? "nothing-measured" : "fitted");
    EXPECT_EQ(row[10], k == 7 || k == 11 ? "1" : "0");
  }
}

}  // namespace
}  // namespace shelfbeam::test
