#include "shelfbeam/signal/measured/comparison.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using SurveyPairs = std::vector<ComparedPair>;

constexpr double true_factor = 37.5;

// A synthetic survey: signals over 25 dB, a simulation and measurements with known errors, and unknown
// errors.
struct Survey {
  std::size_t labels = 40, transceivers = 1;
  double simulation = 0.05;   // relative
  double measurement = 0.05;  // relative to a signal of 1 mW/m^2, with a floor
  bool errors_known = true;
  double pair_db = 0, label_db = 0, transceiver_db = 0;
  double exponent = 1;  // measured = factor x simulated^exponent: a wrong model unless 1

  SurveyPairs draw(std::uint64_t seed) const {
    std::mt19937_64 engine(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform;
    std::vector<double> unit_gain, label_gain;
    for (std::size_t j = 0; j < transceivers; ++j) unit_gain.push_back(transceiver_db * normal(engine));
    for (std::size_t i = 0; i < labels; ++i) label_gain.push_back(label_db * normal(engine));
    SurveyPairs pairs;
    for (std::uint32_t i = 0; i < labels; ++i)
      for (std::uint32_t j = 0; j < transceivers; ++j) {
        const double signal = std::pow(10, -2.5 * uniform(engine));
        const double db = label_gain[i] + unit_gain[j] + pair_db * normal(engine);
        const double shown = true_factor * std::pow(signal, exponent) * std::pow(10, db / 10);
        const double error = measurement * (0.02 * true_factor + shown), sampling = simulation * signal;
        ComparedPair pair{i,       j, shown + error * normal(engine), {}, signal + sampling * normal(engine),
                          sampling};
        if (errors_known) pair.error = error;
        pairs.push_back(pair);
      }
    return pairs;
  }
};

const auto as_it_is = [](SurveyPairs&) {};

/// The share of surveys of which a statement holds.
template <class Change, class Holds>
double share_of(const Survey& survey, int runs, const Change& change, const Holds& holds) {
  int held = 0;
  for (int run = 0; run < runs; ++run) {
    SurveyPairs pairs = survey.draw(1000 + static_cast<std::uint64_t>(run));
    change(pairs);
    held += holds(pairs) ? 1 : 0;
  }
  return static_cast<double>(held) / runs;
}

/// The share of surveys whose interval contains the factor.
template <class Change>
double coverage(const Survey& survey, double confidence, int runs, const Change& change) {
  return share_of(survey, runs, change, [&](const SurveyPairs& pairs) {
    return compare_signals(pairs, confidence).factor_interval.holds(true_factor);
  });
}

/// The table of docs/methods/comparison.md.
struct Coverage {
  const char* name;
  Survey survey;
  double share;
};
const Survey gains{.labels = 10, .transceivers = 10, .label_db = 1.5, .transceiver_db = 1.5};
const std::array coverages{
    Coverage{"40 labels, one transceiver, errors known", {}, 0.944},
    Coverage{"40 labels, spread of 1.5 dB, errors unknown", {.errors_known = false, .pair_db = 1.5}, 0.95},
    Coverage{"8 labels, the same", {.labels = 8, .errors_known = false, .pair_db = 1.5}, 0.934},
    Coverage{"10 labels x 10 transceivers, every label 1.5 dB off",
             {.labels = 10, .transceivers = 10, .label_db = 1.5},
             0.924},
    Coverage{"the same, every label and every transceiver", gains, 0.938},
    Coverage{"50 labels x 3 transceivers, nothing shared", {.labels = 50, .transceivers = 3}, 0.986}};

// The standard error of a share of 95 % is 1.1 % of 400 surveys, that of 80 % 1.3 % of 1000. The bounds are
// three of them plus the error of the approximation by Student's t.
TEST(Comparison, IntervalHasItsNominalCoverage) {
  for (const auto& [name, survey, share] : coverages)
    EXPECT_NEAR(coverage(survey, 0.95, 400, as_it_is), share, 0.04) << name;
  EXPECT_NEAR(coverage({}, 0.8, 1000, as_it_is), 0.8, 0.046);
}

// 4000 surveys: three standard errors of a share of 95 % are 1 %.
TEST(ComparisonSlow, CoverageEqualsTheTable) {
  for (const auto& [name, survey, share] : coverages)
    EXPECT_NEAR(coverage(survey, 0.95, 4000, as_it_is), share, 0.01) << name;
}

TEST(Comparison, IntervalOfAnotherFactorIsRejected) {
  const auto shift = [](SurveyPairs& pairs) {
    for (ComparedPair& pair : pairs) pair.measured *= 1.04;
  };
  EXPECT_LT(coverage({}, 0.95, 500, shift), 0.5);
}

// Labels with individual gains: 10 labels x 10 transceivers are 10 independent observations, not 100.
TEST(Comparison, IntervalAllowsForGainsThatPairsShare) {
  const auto strangers = [](SurveyPairs& pairs) {
    for (std::uint32_t k = 0; k < pairs.size(); ++k) {
      pairs[k].label = k;
      pairs[k].transceiver = k;
    }
  };
  EXPECT_LT(coverage(gains, 0.95, 400, strangers), 0.8) << "as if pairs had nothing in common";
  const Survey of_units{.labels = 10, .transceivers = 10, .transceiver_db = 1.5};
  EXPECT_GE(coverage(of_units, 0.95, 400, as_it_is), 0.88);
}

// The level is 1 %; of 2000 surveys 20 +- 4.4 are rejected by chance, 35 with probability 1e-3.
TEST(Comparison, ChiSquareRejectsDataThatOneFactorDoesNotExplain) {
  const auto is_rejected = [](const SurveyPairs& pairs) { return compare_signals(pairs).test->rejected(); };
  const double by_chance = share_of({}, 2000, as_it_is, is_rejected);
  EXPECT_LE(by_chance, 35.0 / 2000);
  EXPECT_GE(by_chance, 8.0 / 2000) << "a test that hardly ever rejects proves nothing";
  EXPECT_EQ(share_of({.exponent = 0.9}, 200, as_it_is, is_rejected), 1);
  const auto shuffle = [](SurveyPairs& pairs) {
    for (std::size_t k = 0; k + 1 < pairs.size(); k += 2) {
      std::swap(pairs[k].measured, pairs[k + 1].measured);
      std::swap(pairs[k].error, pairs[k + 1].error);
    }
  };
  EXPECT_EQ(share_of({}, 200, shuffle, is_rejected), 1);
}

TEST(Comparison, SlopeRevealsAWrongExponentWithoutErrors) {
  const auto slope_may_be_one = [](const SurveyPairs& pairs) {
    const Comparison comparison = compare_signals(pairs);
    EXPECT_FALSE(comparison.test.has_value());
    return comparison.slope_interval.holds(1);
  };
  Survey survey{.errors_known = false, .pair_db = 1};
  EXPECT_NEAR(share_of(survey, 1000, as_it_is, slope_may_be_one), 0.95, 0.035);
  survey.exponent = 0.85;
  EXPECT_LT(share_of(survey, 1000, as_it_is, slope_may_be_one), 0.05);
}

TEST(Comparison, OutliersAreReportedAndDoNotMoveTheFactor) {
  Survey survey;
  survey.labels = 60;
  survey.pair_db = 0.5;
  int false_alarms = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SurveyPairs pairs = survey.draw(seed);
    const Comparison before = compare_signals(pairs);
    false_alarms += before.outliers.empty() ? 0 : 1;
    // Eight of sixty labels are obstructed.
    std::vector<std::size_t> blocked;
    for (std::size_t k = 0; k < pairs.size() && blocked.size() < 8; ++k)
      if (before.pairs[k].use == PairUse::fitted && pairs[k].simulated > 0.05) blocked.push_back(k);
    for (const std::size_t k : blocked) pairs[k].measured *= 0.1;
    const Comparison after = compare_signals(pairs);
    std::vector<std::size_t> told = after.outliers;
    std::sort(told.begin(), told.end());
    EXPECT_TRUE(std::includes(told.begin(), told.end(), blocked.begin(), blocked.end())) << seed;
    // The mean of the logarithms would be off by 10 dB x 8 / 60 = 1.3 dB.
    EXPECT_NEAR(10 * std::log10(after.factor / before.factor), 0, 0.6) << seed;
  }
  EXPECT_LE(false_alarms, 24) << "1 % with normal errors; tails of estimated deviations add";
}

TEST(Comparison, ZeroMeasurementIsAnOutlierIfMuchIsExpected) {
  for (const bool errors_known : {true, false}) {
    Survey survey;
    survey.errors_known = errors_known;
    SurveyPairs pairs = survey.draw(3);
    const auto strong = static_cast<std::size_t>(
        std::max_element(pairs.begin(), pairs.end(),
                         [](const auto& a, const auto& b) { return a.simulated < b.simulated; }) -
        pairs.begin());
    pairs[strong].measured = 0;
    const Comparison comparison = compare_signals(pairs);
    EXPECT_EQ(comparison.pairs[strong].use, PairUse::measured_zero);
    EXPECT_FALSE(comparison.pairs[strong].residual.has_value());
    EXPECT_EQ(comparison.outliers, std::vector<std::size_t>{strong}) << errors_known;
    EXPECT_EQ(comparison.measured_zero, 1u);
    EXPECT_TRUE(comparison.factor_interval.low < comparison.factor &&
                comparison.factor < comparison.factor_interval.high);
  }
}

TEST(Comparison, SignalWhereNoneIsSimulated) {
  Survey survey;
  SurveyPairs pairs = survey.draw(4);
  pairs.push_back({90, 0, 0.01, 0.02, 0, 0});  // noise
  pairs.push_back({91, 0, 5, 0.02, 0, 0});     // light that the simulation does not have
  pairs.push_back({92, 0, -0.01, 0.02, -1e-9, 1e-8});
  const Comparison comparison = compare_signals(pairs);
  EXPECT_EQ(comparison.outliers, std::vector<std::size_t>{41});
  for (const std::size_t k : {40u, 41u, 42u}) {
    EXPECT_EQ(comparison.pairs[k].use, PairUse::uncertain);
    EXPECT_FALSE(comparison.pairs[k].residual.has_value());
  }
  EXPECT_GE(comparison.uncertain, 3u);
  EXPECT_TRUE(comparison.test->rejected());
}

// Most measurements are noise about zero, half of them negative and without a logarithm.
TEST(Comparison, FaintSignalsDoNotBiasTheFactor) {
  Survey survey;
  survey.labels = 30;
  Survey faint = survey;
  faint.labels = 300;
  double sum = 0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    SurveyPairs pairs = survey.draw(static_cast<std::uint64_t>(run));
    for (ComparedPair pair : faint.draw(100 + static_cast<std::uint64_t>(run))) {
      const double noise = (pair.measured - true_factor * pair.simulated) / *pair.error;
      pair.simulated *= 1e-4;
      pair.standard_error *= 1e-4;
      pair.error = 0.05;
      pair.measured = true_factor * pair.simulated + 0.05 * noise;
      pairs.push_back(pair);
    }
    sum += 10 * std::log10(compare_signals(pairs).factor / true_factor) / runs;
  }
  // On average, the logarithm of a signal of five standard errors is 0.09 dB too low.
  EXPECT_NEAR(sum, 0, 0.05) << "dB";
}

TEST(Comparison, PerfectDataFitExactly) {
  SurveyPairs pairs;
  for (std::uint32_t k = 0; k < 12; ++k) {
    const double signal = 0.001 * (k + 1);
    pairs.push_back({k, {}, 4 * signal, {}, signal, 0});
  }
  const Comparison comparison = compare_signals(pairs);
  EXPECT_NEAR(comparison.factor, 4, 1e-12);
  EXPECT_NEAR(comparison.factor_interval.high, comparison.factor_interval.low, 1e-9);
  EXPECT_LT(comparison.spread, 1e-9);
  EXPECT_NEAR(comparison.correlation, 1, 1e-12);
  EXPECT_NEAR(*comparison.slope, 1, 1e-12);
  EXPECT_TRUE(comparison.outliers.empty());
}

TEST(Comparison, ScalingTheMeasurementsScalesOnlyTheFactor) {
  const SurveyPairs pairs = Survey{}.draw(9);
  SurveyPairs scaled = pairs;
  for (ComparedPair& pair : scaled) {
    pair.measured *= 1024;
    pair.error = 1024 * *pair.error;
  }
  const Comparison a = compare_signals(pairs), b = compare_signals(scaled);
  EXPECT_NEAR(b.factor / a.factor, 1024, 1e-9);
  EXPECT_NEAR(b.test->statistic, a.test->statistic, 1e-9 * a.test->statistic);
  EXPECT_NEAR(b.residual_quantile_90, a.residual_quantile_90, 1e-9);
}

TEST(Comparison, ReportsDataThatCannotBeFitted) {
  SurveyPairs pairs = Survey{}.draw(2);
  SurveyPairs two(pairs.begin(), pairs.begin() + 2);
  expect_input_error([&] { compare_signals(two, 0.95, "m.csv"); }, "m.csv", "2 signals", "three");
  for (ComparedPair& pair : pairs) pair.measured = -60;
  expect_input_error([&] { compare_signals(pairs, 0.95, "m.csv"); }, "m.csv", "decibels");
}

}  // namespace
}  // namespace shelfbeam::test
