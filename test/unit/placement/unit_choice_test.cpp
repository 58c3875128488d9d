#include "shelfbeam/signal/constraints/unit_choice.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/coverage/max_coverage.hpp"

#include "support/expect_input_error.hpp"
#include "unit/placement/brute_force.hpp"
#include "unit/placement/enumeration.hpp"

namespace shelfbeam {
namespace {

using test::BruteForce;
using test::RandomTables;

struct Question {
  SignalTable table;  ///< with all columns
  Selection pinned, excluded;
  PlacementProblem problem;

  UnitChoice choice() const {
    UnitChoice choice;
    for (const std::uint32_t j : pinned) choice.pinned.push_back(table.transceivers[j].id);
    for (const std::uint32_t j : excluded) choice.excluded.push_back(table.transceivers[j].id);
    return choice;
  }
};

// Pins and exclusions of columns that are not installed; at most one unit is given per mounting point.
Question next_question(RandomTables& random) {
  Question question{random.next(), {}, {}, random.next_problem()};
  SignalTable& table = question.table;
  if (random.chance(0.4))
    question.problem = {.model = question.problem.model,
                        .combination = Combination::spend,
                        .redundant = question.problem.redundant};
  question.problem.redundant = random.chance(0.2);
  std::vector<bool> is_given(table.columns());
  for (std::uint32_t j = 0; j < table.columns(); ++j) is_given[j] = table.transceivers[j].installed;
  const auto is_free = [&](std::uint32_t j) {
    return std::none_of(table.mounts.begin(), table.mounts.end(), [&](const auto& mount) {
      return std::find(mount.begin(), mount.end(), j) != mount.end() &&
             std::any_of(mount.begin(), mount.end(), [&](std::uint32_t k) { return is_given[k]; });
    });
  };
  for (std::uint32_t j = 0; j < table.columns(); ++j) {
    if (is_given[j]) continue;
    if (random.chance(0.12) && is_free(j)) {
      question.pinned.push_back(j);
      is_given[j] = true;
    } else if (random.chance(0.25)) {
      question.excluded.push_back(j);
    }
  }
  if (question.excluded.size() == table.columns()) question.excluded.clear();
  return question;
}

// The minimum, by enumeration of the selections of the whole table; nullopt if none reaches all labels.
std::optional<double> enumerated(const Question& question, bool knows_pins = true,
                                 bool knows_exclusions = true) {
  SignalTable table = question.table;
  std::vector<double> price;
  for (const auto& unit : table.transceivers) price.push_back(unit.installed ? 0 : unit.cost);
  if (knows_pins)
    for (const std::uint32_t j : question.pinned) table.transceivers[j].installed = true;
  std::erase_if(table.conflicts, [&](const auto& pair) {
    return table.transceivers[pair.first].installed && table.transceivers[pair.second].installed;
  });
  const auto is_excluded = [&](std::uint32_t j) {
    return std::find(question.excluded.begin(), question.excluded.end(), j) != question.excluded.end();
  };
  const Combination order = question.problem.combination;
  std::vector<BruteForce::Answer> answers = BruteForce::answers(table, question.problem);
  if (knows_exclusions)
    std::erase_if(answers, [&](const auto& answer) {
      return std::any_of(answer.columns.begin(), answer.columns.end(), is_excluded);
    });
  if (answers.empty()) return {};
  if (order == Combination::lexicographic) {
    std::size_t fewest = table.columns();
    for (const auto& answer : answers) fewest = std::min(fewest, answer.columns.size());
    std::erase_if(answers, [&](const auto& answer) { return answer.columns.size() > fewest; });
  }
  double best = std::numeric_limits<double>::infinity();
  for (const auto& answer : answers) {
    double value = answer.price + answer.second_objective;
    if (order == Combination::spend) {
      value = 0;
      for (const std::uint32_t j : answer.columns) value += price[j];
    } else if (order == Combination::lexicographic) {
      value = question.problem.objective == Objective::count ? static_cast<double>(answer.columns.size())
                                                             : answer.second_objective;
    }
    best = std::min(best, value);
  }
  return best;
}

bool differs(std::optional<double> a, std::optional<double> b) {
  return a.has_value() != b.has_value() || (a && std::abs(*a - *b) > 2e-6 * std::max(1.0, std::abs(*b)));
}

class PinnedAndExcludedUnits : public testing::TestWithParam<SolverChoice> {};
INSTANTIATE_TEST_SUITE_P(Solvers, PinnedAndExcludedUnits,
                         testing::Values(SolverChoice::automatic, SolverChoice::mip));

TEST_P(PinnedAndExcludedUnits, EqualEnumeration) {
  RandomTables random(
      50, {.labels = 5, .transceivers = 12, .borderline = false, .mounts = true, .conflicts = true});
  int infeasible = 0, with_pins = 0, with_exclusions = 0, free_pins = 0;
  for (int k = 0; k < 300; ++k) {
    SCOPED_TRACE(testing::Message() << "question " << k);
    const Question question = next_question(random);
    SignalTable table = question.table;
    if (table.columns() == 0) continue;
    question.choice().apply(table, "matrix");
    ASSERT_EQ(table.columns() + question.excluded.size(), question.table.columns());
    const Placement answer = place(table, question.problem,
                                   {.solver = GetParam(), .step_limit = test::ample_steps}, {.threads = 1});
    const std::optional<double> best = enumerated(question);
    infeasible += best ? 0 : 1;
    with_pins += differs(enumerated(question, false, true), best);
    with_exclusions += differs(enumerated(question, true, false), best);
    ASSERT_EQ(answer.status, best ? Status::optimal : Status::infeasible);
    if (!best) continue;
    EXPECT_NEAR(answer.objective_value, *best, 2e-6 * std::max(1.0, std::abs(*best)));
    std::vector<std::string> ids;
    for (const std::uint32_t j : answer.selected) ids.push_back(table.transceivers[j].id);
    const auto is_chosen = [&](std::uint32_t j) {
      return std::find(ids.begin(), ids.end(), question.table.transceivers[j].id) != ids.end();
    };
    EXPECT_TRUE(std::all_of(question.pinned.begin(), question.pinned.end(), is_chosen));
    EXPECT_TRUE(std::none_of(question.excluded.begin(), question.excluded.end(), is_chosen));
    // A pinned unit has its price, an installed one is free.
    double to_spend = 0;
    for (const std::uint32_t j : answer.selected)
      if (!table.transceivers[j].installed || table.transceivers[j].pinned)
        to_spend += table.transceivers[j].cost;
    EXPECT_NEAR(price_of(table, answer.selected).to_spend, to_spend, 1e-9);
    SignalTable as_installed = table;
    for (auto& unit : as_installed.transceivers) unit.pinned = false;
    free_pins += question.problem.combination == Combination::spend &&
                 differs(price_of(as_installed, answer.selected).to_spend, to_spend);
  }
  // Enumerations that ignore a rule find another value for many questions.
  EXPECT_GT(with_pins, 30);
  EXPECT_GT(with_exclusions, 10);
  EXPECT_GT(free_pins, 10);
  EXPECT_GT(infeasible, 20);
  EXPECT_LT(infeasible, 220);
}

TEST(PinnedAndExcludedUnits, LimitTheCoverageOfFewUnits) {
  RandomTables random(51, {.labels = 8, .transceivers = 9, .borderline = false, .mounts = true});
  int compared = 0;
  for (int k = 0; k < 100; ++k) {
    const Question question = next_question(random);
    SignalTable table = question.table;
    if (table.columns() == 0 || table.rows() == 0) continue;
    question.choice().apply(table, "matrix");
    const auto budgets = BruteForce::budgets(table, question.problem);
    for (std::size_t units = 0; units < budgets.size(); ++units) {
      if (!budgets[units]) continue;
      const MaxCoverage reach = maximise_coverage(table, question.problem, units, {}, {.threads = 1});
      EXPECT_EQ(reach.reached, budgets[units]->reached) << "question " << k;
      ++compared;
    }
  }
  EXPECT_GT(compared, 300);
}

// A table of the given units, a group of three options and a forbidden pair.
SignalTable five_units() {
  SignalTable table = test::make_table({{1, 0, 0.5, 0, 2}, {0, 3, 0, 0.25, 0}}, 5);
  table.mounts = {{0, 1, 3}};
  table.conflicts = {{1, 2}, {2, 4}};
  return table;
}

TEST(UnitChoice, RemovesColumns) {
  SignalTable table = five_units();
  UnitChoice{{"T4"}, {"T0", "T2"}}.apply(table, "matrix");
  ASSERT_EQ(table.columns(), 3u);
  EXPECT_EQ(table.transceivers[2].id, "T4");
  EXPECT_TRUE(table.transceivers[2].pinned && table.transceivers[2].installed);
  EXPECT_EQ(table.mounts, (std::vector<Selection>{{0, 1}}));
  EXPECT_TRUE(table.conflicts.empty());
  EXPECT_EQ(table.excluded, (std::vector<std::string>{"T0", "T2"}));
  ASSERT_EQ(table.row(0).size(), 1u);
  EXPECT_EQ(table.row(0)[0].transceiver, 2u);
  ASSERT_EQ(table.row(1).size(), 2u);
  EXPECT_EQ(table.row(1)[1].transceiver, 1u);
}

TEST(UnitChoice, AcceptsPatterns) {
  SignalTable table = five_units();
  table.transceivers[3].id = "till";
  UnitChoice{{"t*"}, {"T?"}}.apply(table, "matrix");
  ASSERT_EQ(table.columns(), 1u);
  EXPECT_TRUE(table.transceivers[0].pinned);
}

TEST(UnitChoice, RejectsUnknownAndContradictoryUnits) {
  const auto refused = [](const UnitChoice& choice, Setting setting, const char* text) {
    SignalTable table = five_units();
    table.transceivers[2].installed = true;
    table.transceivers[0].id = "ceiling-1";
    try {
      choice.apply(table, "matrix.h5");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_EQ(error.setting(), setting);
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("matrix.h5"), std::string::npos) << error.what();
    }
  };
  refused({{"ceiling1"}, {}}, Setting::pinned, "did you mean 'ceiling-1'?");
  refused({{}, {"ceilng-1"}}, Setting::excluded, "did you mean 'ceiling-1'?");
  refused({{"T1"}, {"T*"}}, Setting::excluded, "'T1' is pinned and excluded");
  refused({{}, {"T2"}}, Setting::excluded, "'T2' is installed and excluded");
  refused({{"T1", "T3"}, {}}, Setting::pinned, "'T1' and 'T3' share a mounting point");
  SignalTable table = five_units();
  test::expect_input_error([&] { UnitChoice{{}, {"*"}}.apply(table, "m"); }, "m: ", "no other transceivers");
}

}  // namespace
}  // namespace shelfbeam
