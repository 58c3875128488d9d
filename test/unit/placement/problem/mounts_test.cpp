#include "shelfbeam/placement/problem/mounts.hpp"

#include <gtest/gtest.h>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/problem/checker.hpp"
#include "shelfbeam/signal/signal_matrix.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

constexpr auto coop = CommunicationModel::cooperative;
constexpr auto alone = CommunicationModel::non_cooperative;

TEST(Mounts, KnowWhatExcludesWhat) {
  SignalTable table = test::make_table({{0.5, 0.75, 0.25, 1, 2}}, 5);
  table.mounts = {{1, 3}, {2, 4}};
  table.transceivers[2].installed = true;
  const Mounts mounts(table);
  EXPECT_TRUE(mounts.options(0).empty());
  EXPECT_EQ(mounts.options(3).size(), 2U);
  EXPECT_EQ(mounts.options(3)[0], 1U);
  for (const std::uint32_t j : {0U, 1U, 2U, 3U}) EXPECT_TRUE(mounts.available(j)) << j;
  EXPECT_FALSE(mounts.available(4));
  EXPECT_EQ(mounts.most_signal(table.row(0), {coop}), 0.5 + 1 + 0.25);
  EXPECT_EQ(mounts.most_signal(table.row(0), {alone}), 1);
  EXPECT_EQ(table.mounting_points(), 3U);
  EXPECT_EQ(crowded_mounts(table, {true, true, true, false, true}), std::vector<std::uint32_t>{1});
}

TEST(Mounts, KnowWhatAPairExcludes) {
  SignalTable table = test::make_table({{0.5, 0.75, 0.25, 1, 2}}, 5);
  table.mounts = {{1, 3}};
  table.apart = {{0, 2}, {0, 4}, {1, 2}};
  table.transceivers[4].installed = true;
  const Mounts mounts(table);
  EXPECT_EQ(mounts.partners(0).size(), 2U);
  std::vector<std::uint32_t> excluded;
  mounts.for_each_excluded(1, [&](std::uint32_t j) { excluded.push_back(j); });
  EXPECT_EQ(excluded, (std::vector<std::uint32_t>{3, 2}));
  EXPECT_FALSE(mounts.available(0)) << "an installed unit is too near";
  EXPECT_TRUE(mounts.available(2));
  EXPECT_EQ(mounts.most_signal(table.row(0), {coop}), 0.25 + 1 + 2);
  EXPECT_EQ(mounts.most_signal(table.row(0), {.model = coop, .redundant = true}), 0.25 + 1);
  EXPECT_EQ(mounts.most_signal(table.row(0), {.model = alone, .redundant = true}), 1);
  EXPECT_EQ(broken_pairs(table, {true, true, true, false, false}), (std::vector<std::uint32_t>{0, 2}));
}

/// A table as a simulated matrix: every unit at a place of its own.
SignalMatrix as_matrix(const SignalTable& table) {
  SignalMatrix matrix;
  for (const auto& label : table.labels)
    matrix.labels.push_back(
        {label.id, "", {}, {}, label.requirement, label.link_cost, label.signal_cost, 2, 2});
  matrix.mean.assign(table.rows() * table.columns(), 0);
  for (std::size_t j = 0; j < table.columns(); ++j) {
    const std::size_t across = j % 3, along = j / 3;
    matrix.transceivers.push_back({table.transceivers[j].id,
                                   "",
                                   {0.1 * static_cast<double>(across), 0.3 * static_cast<double>(along), 3},
                                   {0, 0, -1},
                                   table.transceivers[j].cost,
                                   table.transceivers[j].installed});
  }
  for (std::size_t i = 0; i < table.rows(); ++i)
    for (const SignalEntry& entry : table.row(i))
      matrix.mean[matrix.at(i, entry.transceiver)] = static_cast<float>(entry.signal);
  return matrix;
}

/// Every unit a second time, `away` metres beside it, with entries times `weaken` and a price higher by 1.
SignalMatrix doubled(const SignalMatrix& matrix, double away, float weaken) {
  SignalMatrix result = matrix;
  result.mean.clear();
  for (TransceiverColumn unit : matrix.transceivers) {
    unit.id += "b";
    unit.position.x += away;
    unit.cost += 1;
    unit.installed = false;
    result.transceivers.push_back(unit);
  }
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    for (const float signal : matrix.mean_row(i)) result.mean.push_back(signal);
    for (const float signal : matrix.mean_row(i)) result.mean.push_back(weaken * signal);
  }
  return result;
}

// A second option that is worse in every respect changes no optimum: as strong but dearer, or, where signals
// are not priced, weaker too. 1 cm away it is a candidate of its own, and may make the optimum better but not
// worse. Optima are proven within a relative gap of 1e-6 each.
TEST(Mounts, AWorseOptionChangesNothing) {
  test::RandomTables tables(61, {.labels = 6, .transceivers = 7, .borderline = false});
  int feasible = 0, better = 0, possible = 0;
  for (int k = 0; k < 600; ++k) {
    SCOPED_TRACE(k);
    const SignalTable table = tables.next();
    const Question question = tables.next_question();
    const float weaken = question.objective == Objective::count ? 0.5F : 1.0F;
    const SignalMatrix matrix = as_matrix(table);
    const Placement single = place(make_signal_table(matrix), question, {});
    const SignalTable options = make_signal_table(doubled(matrix, 1e-7, weaken));
    const SignalTable apart = make_signal_table(doubled(matrix, 0.01, weaken));
    ASSERT_EQ(options.mounts.size(), matrix.columns());
    ASSERT_TRUE(apart.mounts.empty());

    const Placement same = place(options, question, {});
    EXPECT_EQ(same.status, single.status);
    const Placement more = place(apart, question, {});
    possible += single.status == Status::infeasible && more.status == Status::optimal;
    if (single.status == Status::infeasible) {
      EXPECT_EQ(same.unreachable.size(), single.unreachable.size());
      continue;
    }
    ++feasible;
    ASSERT_EQ(more.status, Status::optimal);
    const double slack = 2e-6 * single.objective_value;
    EXPECT_NEAR(same.objective_value, single.objective_value, slack);
    EXPECT_EQ(question.combination == Combination::lexicographic ? same.count() : 0,
              question.combination == Combination::lexicographic ? single.count() : 0);
    if (question.combination == Combination::weighted) {
      EXPECT_LE(more.objective_value, single.objective_value + slack);
    } else {
      EXPECT_LE(more.count(), single.count());
    }
    // Negative control: what two units 1 cm apart can do, two options cannot.
    if (more.objective_value < single.objective_value - slack) {
      ++better;
      if (question.combination == Combination::weighted || more.count() < single.count()) {
        EXPECT_FALSE(check_selection(options, question, more.selected).met());
      }
    }
  }
  EXPECT_GT(feasible, 200);
  EXPECT_GT(better, 10);
  EXPECT_GT(possible, 20);
}

}  // namespace
}  // namespace shelfbeam
