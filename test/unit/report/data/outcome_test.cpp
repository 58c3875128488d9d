#include "shelfbeam/report/data/outcome.hpp"

#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

#include "unit/report/shops.hpp"

namespace shelfbeam::test {
namespace {

Placement some_units(std::uint32_t columns, std::uint32_t trial, CommunicationModel model) {
  Placement placement;
  placement.problem.model = model;
  placement.status = Status::feasible;
  for (std::uint32_t j = 0; j < columns; ++j)
    if (to_uniform(philox({j, trial, 5, 0}, 3)[0]) < 0.5) placement.selected.push_back(j);
  return placement;
}

// Compares all numbers of an outcome with plain double loops and with the checker that examines every
// placement. Both sides add the same 32-bit values in the same order in double precision, so equality is
// exact.
bool agrees(const Outcome& outcome, const SignalMatrix& matrix, const Placement& placement) {
  const SignalTable table = make_signal_table(matrix);
  const auto check_of = [&](Selection selected) {
    return check_selection(table, placement.problem, selected);
  };
  const Check check = check_of(placement.selected);
  Selection all(matrix.columns());
  for (std::uint32_t j = 0; j < all.size(); ++j) all[j] = j;
  const Check everything = check_of(all);
  const auto unmet = [](const Check& c, std::uint32_t i) {
    return std::find(c.unmet.begin(), c.unmet.end(), i) != c.unmet.end();
  };
  const bool adds_up = placement.problem.model == CommunicationModel::cooperative;

  for (std::uint32_t i = 0; i < matrix.rows(); ++i) {
    const LabelOutcome& label = outcome.labels[i];
    double direct = 0, largest = 0;
    for (const std::uint32_t j : placement.selected) {
      const auto mean = static_cast<double>(matrix.mean[i * matrix.columns() + j]);
      const auto part = static_cast<double>(matrix.direct[i * matrix.columns() + j]);
      if (adds_up) direct += part;
      if (!adds_up && mean > largest) direct = part;
      largest = std::max(largest, mean);
    }
    if (label.signal != check.signal[i] || label.direct != direct || label.best != everything.signal[i])
      return false;
    if (label.strongest.has_value() != (largest > 0)) return false;
    if (label.strongest && matrix.mean[matrix.at(i, *label.strongest)] != static_cast<float>(largest))
      return false;
    if (label.reached_by.size() != check.serving[i]) return false;
    if (!placement.selected.empty() && label.met == unmet(check, i)) return false;
  }
  for (std::size_t k = 0; k < placement.selected.size(); ++k) {
    const std::uint32_t column = placement.selected[k];
    Selection without = placement.selected;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
    const Check rest = check_of(without);
    UnitOutcome expected{column, 0, 0, 0};
    for (std::uint32_t i = 0; i < matrix.rows(); ++i) {
      const auto mean = static_cast<double>(matrix.mean[i * matrix.columns() + column]);
      if (mean >= matrix.labels[i].requirement * (1 - 1e-9)) ++expected.reaches_alone;
      if (mean > 0 && outcome.labels[i].strongest == column) ++expected.strongest_for;
      if (!unmet(check, i) && unmet(rest, i)) ++expected.needed_by;
    }
    const UnitOutcome& unit = outcome.units[k];
    if (unit.column != expected.column || unit.reaches_alone != expected.reaches_alone ||
        unit.strongest_for != expected.strongest_for || unit.needed_by != expected.needed_by)
      return false;
  }
  const auto redundant =
      std::count_if(check.serving.begin(), check.serving.end(), [](auto n) { return n >= 2; });
  if (outcome.redundant != static_cast<std::size_t>(redundant)) return false;
  PlacementProblem with_failure = placement.problem;
  with_failure.redundant = true;
  if (outcome.secure != matrix.rows() - check_selection(table, with_failure, placement.selected).unmet.size())
    return false;
  const double least = outcome.labels[outcome.by_margin.front()].margin();
  return outcome.met == matrix.rows() - check.unmet.size() &&
         std::all_of(outcome.labels.begin(), outcome.labels.end(),
                     [&](const auto& l) { return l.margin() >= least; });
}

TEST(Outcome, EqualsAPlainRecomputation) {
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative})
    for (std::uint32_t trial = 0; trial < 100; ++trial) {
      SignalMatrix matrix = random_matrix(12, 6, trial);
      const Placement placement = some_units(6, trial, model);
      if (placement.selected.empty()) continue;
      const Outcome outcome = outcome_of(matrix, placement);
      ASSERT_TRUE(agrees(outcome, matrix, placement)) << trial;
      // Negative control: the smallest relevant change of one chosen entry must be noticed.
      float& entry = matrix.mean[3 * 6 + placement.selected.front()];
      const bool counts =
          model == CommunicationModel::cooperative || outcome.labels[3].strongest == placement.selected[0];
      entry += 0.01F;
      if (counts) {
        EXPECT_FALSE(agrees(outcome, matrix, placement)) << trial;
      }
    }
}

TEST(Outcome, CountsLabelsAfterTheWorstFailure) {
  SignalMatrix matrix = random_matrix(2, 3, 0);
  matrix.labels[0].requirement = matrix.labels[1].requirement = 1;
  matrix.mean = {1, 1, 0, 0, 4, 0.5F};
  matrix.direct = {1, 0.5F, 0, 0, 1, 0};
  Placement placement;
  placement.selected = {0, 1};
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative}) {
    placement.problem = {.model = model, .redundant = true};
    const Outcome outcome = outcome_of(matrix, placement);
    EXPECT_TRUE(outcome.labels[0].met);
    EXPECT_EQ(outcome.labels[0].signal, 1);
    EXPECT_EQ(outcome.labels[0].direct, 0.5);
    EXPECT_FALSE(outcome.labels[1].met);
    EXPECT_EQ(outcome.labels[1].signal, 0);
    EXPECT_EQ(outcome.labels[1].best, 0.5);
    EXPECT_EQ(outcome.units[0].needed_by + outcome.units[1].needed_by, 0U);
    EXPECT_EQ(outcome.met, 1U);
  }
}

TEST(Outcome, KnownValues) {
  SignalMatrix matrix = random_matrix(2, 3, 0);
  matrix.labels[0].requirement = 2;
  matrix.labels[1].requirement = 1;
  matrix.mean = {1, 1, 0, 0, 4, 0.5F};
  matrix.direct = {1, 0.5F, 0, 0, 1, 0};
  Placement placement;
  placement.selected = {0, 1};
  const Outcome outcome = outcome_of(matrix, placement);
  EXPECT_TRUE(outcome.labels[0].met);
  EXPECT_DOUBLE_EQ(outcome.labels[0].margin(), 0);
  EXPECT_DOUBLE_EQ(outcome.labels[1].margin(), 10 * std::log10(4));
  EXPECT_EQ(outcome.labels[0].strongest, 0U);  // the first of equal signals
  EXPECT_DOUBLE_EQ(outcome.labels[1].best, 4.5);
  EXPECT_EQ(outcome.labels[1].reached_by, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(outcome.units[0].needed_by, 1U);
  EXPECT_EQ(outcome.units[1].needed_by, 2U);
  EXPECT_EQ(outcome.units[0].strongest_for, 1U);
  EXPECT_EQ(outcome.met_by_direct_light, 1U);
  EXPECT_EQ(outcome.redundant, 0U);
  EXPECT_EQ(outcome.served_by(0), (std::vector<LabelId>{0}));  // reached by none alone
  EXPECT_EQ(outcome.served_by(1), (std::vector<LabelId>{1}));
  EXPECT_EQ(outcome.direct_shares(), (std::vector<double>{0.75, 0.25}));

  matrix.labels[0].requirement = 1;  // now both units reach it
  EXPECT_EQ(outcome_of(matrix, placement).redundant, 1U);
  EXPECT_EQ(outcome_of(matrix, placement).served_by(1), (std::vector<LabelId>{0, 1}));
  matrix.labels[0].requirement = 2;

  placement.problem.model = CommunicationModel::non_cooperative;
  const Outcome alone = outcome_of(matrix, placement);
  EXPECT_FALSE(alone.labels[0].met);
  EXPECT_DOUBLE_EQ(alone.labels[0].margin(), 10 * std::log10(0.5));
  EXPECT_EQ(alone.met, 1U);
  EXPECT_EQ(alone.units[0].needed_by, 0U);
  EXPECT_EQ(alone.by_margin, (std::vector<LabelId>{0, 1}));
}

TEST(Outcome, FindsLabelsThatDependOnFlaggedEntries) {
  SignalMatrix matrix = random_matrix(1, 4, 0);
  matrix.labels[0].requirement = 2;
  matrix.mean = {3, 1, 2, 5};
  Placement placement;
  placement.selected = {0, 1, 2};
  std::optional<Certificate> certificate;
  const auto hangs = [&](std::vector<std::uint8_t> flags) {
    matrix.flags = std::move(flags);
    const Outcome outcome = outcome_of(matrix, placement, certificate);
    EXPECT_EQ(outcome.flagged_labels, outcome.labels[0].depends_on_flagged ? 1U : 0U);
    return outcome.labels[0].depends_on_flagged;
  };
  EXPECT_FALSE(hangs({}));
  EXPECT_FALSE(hangs({0, 0, 0, 0}));
  EXPECT_FALSE(hangs({1, 0, 0, 0}));  // 1 + 2 remain
  EXPECT_TRUE(hangs({1, 0, 1, 0}));
  EXPECT_FALSE(hangs({0, 0, 0, 1}));  // was not chosen
  certificate = Certificate{};        // verdicts from independent samples replace those of the matrix
  for (const Verdict verdict : {Verdict::reached, Verdict::missed, Verdict::undecided}) {
    certificate->labels = {LabelVerdict{verdict}};
    EXPECT_EQ(hangs({1, 0, 1, 0}), verdict == Verdict::undecided);
  }
  certificate.reset();
  placement.problem.model = CommunicationModel::non_cooperative;
  EXPECT_FALSE(hangs({1, 1, 0, 0}));
  EXPECT_TRUE(hangs({1, 0, 1, 0}));
  placement.problem.redundant = true;  // two must reach it
  EXPECT_FALSE(hangs({0, 1, 0, 0}));
  EXPECT_TRUE(hangs({1, 0, 0, 0}));
  placement.problem = {};
  matrix.labels[0].requirement = 7;  // a missed label may be reached if an error is too small
  EXPECT_TRUE(hangs({0, 1, 0, 0}));
  EXPECT_FALSE(hangs({0, 0, 0, 1}));
  matrix.mean[1] = 0.1F;  // too small to matter
  EXPECT_FALSE(hangs({0, 1, 0, 0}));
  placement.selected.clear();
  EXPECT_FALSE(hangs({1, 1, 1, 1}));
}

// An installed or a pinned unit occupies its mounting point, as for the search.
TEST(Outcome, BestUsesOneOptionPerMountingPoint) {
  SignalMatrix matrix = random_matrix(1, 4, 0);
  matrix.mean = {1, 0.5F, 0.25F, 2};
  for (TransceiverColumn& unit : matrix.transceivers) unit.installed = false;
  const auto expect_best = [&](double together, double alone) {
    Placement placement;
    placement.selected = {0};
    placement.problem.model = CommunicationModel::cooperative;
    EXPECT_EQ(outcome_of(matrix, placement).labels[0].best, together);
    placement.problem.model = CommunicationModel::non_cooperative;
    EXPECT_EQ(outcome_of(matrix, placement).labels[0].best, alone);
  };
  expect_best(3.75, 2);
  matrix.transceivers[3].position = matrix.transceivers[0].position;
  expect_best(2.75, 2);
  matrix.transceivers[0].installed = true;
  expect_best(1.75, 1);
  matrix.transceivers[0].installed = false;
  matrix.transceivers[0].pinned = true;
  expect_best(1.75, 1);
}

TEST(Outcome, WithoutASelectionNothingIsMet) {
  SignalMatrix matrix = random_matrix(3, 2, 0);
  matrix.direct.clear();
  const Outcome outcome = outcome_of(matrix, Placement{});
  EXPECT_EQ(outcome.met, 0U);
  EXPECT_TRUE(outcome.units.empty());
  EXPECT_TRUE(std::isinf(outcome.labels[0].margin()));
  EXPECT_FALSE(outcome.labels[0].strongest);
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0.5), 2);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantile({5}, 0.9), 5);
  EXPECT_DOUBLE_EQ(quantile({}, 0.9), 0);
}

}  // namespace
}  // namespace shelfbeam::test
