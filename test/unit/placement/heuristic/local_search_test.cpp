#include "shelfbeam/placement/heuristic/local_search.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam::detail {
namespace {

using Columns = std::vector<std::uint32_t>;

double value_of(const SearchProblem& problem, const Columns& selected) {
  if (problem.question.combination == Combination::lexicographic) return static_cast<double>(selected.size());
  return static_cast<double>(problem.cost_of(selected));
}

struct Tally {
  int started = 0, better = 0, best = 0;
};

// Starts from all that may be chosen together, and from the greedy selection.
Tally run(std::uint64_t seed, int cases, const test::RandomTableLimits& limits) {
  test::RandomTables random(seed, limits);
  Tally tally;
  for (int k = 0; k < cases && !testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const Question question = random.next_question();
    const SearchProblem problem(table, question);
    const SearchMatrix all(table, question.model);
    const auto answers = test::BruteForce::answers(table, question);
    if (answers.empty()) continue;
    const Columns& start =
        answers[static_cast<std::size_t>(random.whole(0, static_cast<int>(answers.size()) - 1))].columns;
    const SearchEffort effort{.moves = 300, .walks = 3};
    const auto found = local_search(problem, all, start, effort, {.threads = 1});
    ++tally.started;
    for (const unsigned threads : {2U, 4U})
      EXPECT_EQ(local_search(problem, all, start, effort, {.threads = threads}), found);
    double least = value_of(problem, start);
    for (const auto& answer : answers) least = std::min(least, value_of(problem, answer.columns));
    tally.best += value_of(problem, found.value_or(start)) == least;
    if (!found) continue;
    ++tally.better;
    EXPECT_TRUE(std::is_sorted(found->begin(), found->end()));
    EXPECT_LT(value_of(problem, *found), value_of(problem, start));
    EXPECT_TRUE(check_selection(table, question, *found).met());
    EXPECT_TRUE(
        std::includes(found->begin(), found->end(), problem.installed.begin(), problem.installed.end()));
    EXPECT_TRUE(std::any_of(answers.begin(), answers.end(),
                            [&](const auto& answer) { return answer.columns == *found; }));
  }
  return tally;
}

TEST(LocalSearch, FindsValidAndMostlyTheBestSelections) {
  const Tally plain = run(1, 1200, {.transceivers = 10});
  EXPECT_GT(plain.better, 300);
  EXPECT_GT(plain.best, plain.started * 9 / 10);
}

TEST(LocalSearch, KeepsToMountsPairsAndFailures) {
  const Tally more =
      run(2, 1200, {.labels = 6, .transceivers = 10, .mounts = true, .apart = true, .redundant = true});
  EXPECT_GT(more.better, 100);
  EXPECT_GT(more.best, more.started * 8 / 10);
}

TEST(LocalSearch, TakesUnitsThatCostNothing) {
  SignalTable table = test::make_table({{1, 0, 1}, {0, 1, 1}}, 3);
  table.transceivers[0].cost = table.transceivers[1].cost = 0;
  const Question question{CommunicationModel::cooperative, Objective::count, Combination::weighted};
  const SearchProblem problem(table, question);
  const SearchMatrix all(table, question.model);
  EXPECT_EQ(local_search(problem, all, {2}, {}, {}), (Columns{0, 1}));
  EXPECT_EQ(local_search(problem, all, {0, 1}, {}, {}), std::nullopt) << "nothing costs less";
}

TEST(LocalSearch, EndsWithoutLabelsWalksAndTime) {
  for (const SignalTable& table : {test::make_table({}, 3), test::make_table({}, 0)}) {
    const Question question;
    const SearchProblem problem(table, question);
    const SearchMatrix all(table, question.model);
    Columns start;
    for (std::uint32_t j = 0; j < table.columns(); ++j) start.push_back(j);
    const auto found = local_search(problem, all, start, {}, {});
    EXPECT_EQ(found.value_or(start), Columns{});
    EXPECT_EQ(local_search(problem, all, start, {.walks = 0}, {}), std::nullopt);
  }
}

#ifdef SHELFBEAM_LARGE_INSTANCES
TEST(LocalSearchSlow, FindsTheBestKnownOfTheSupermarket) {
  const SignalTable table = read_signal_table(SHELFBEAM_LARGE_INSTANCES "/super_s1_e0.txt.gz");
  const Question question;
  const SearchProblem problem(table, question);
  const SearchMatrix all(table, question.model);
  const auto found =
      local_search(problem, all, greedy_selection(table, question), {.moves = 200000, .walks = 2}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(check_selection(table, question, *found).met());
  EXPECT_EQ(found->size(), 26U);
}
#endif

// More labels than the search begins with, and sums and links that single precision takes for met and the
// rule does not: such labels must be asked for more, not for ever.
TEST(LocalSearch, GetsPastLabelsThatAreMetInSinglePrecisionOnly) {
  constexpr std::size_t labels = 600;
  for (const auto model : {CommunicationModel::cooperative, CommunicationModel::non_cooperative}) {
    const bool adds_up = model == CommunicationModel::cooperative;
    std::vector<std::vector<double>> matrix(labels, {1, 0, 1, 0});
    for (std::size_t i = labels / 2; i < labels; ++i)
      matrix[i] = {adds_up ? 0.5 : 1 - 2e-9, adds_up ? 0.5 - 5e-9 : 1 - 3e-8, 0, 1};
    const SignalTable table = test::make_table(matrix, 4);
    const Question question{model};
    const SearchProblem problem(table, question);
    const SearchMatrix all(table, model);
    const auto found = local_search(problem, all, {0, 1, 2, 3}, {.moves = 2000}, {.threads = 1});
    ASSERT_TRUE(found);
    EXPECT_TRUE(check_selection(table, question, *found).met());
    EXPECT_EQ(found->size(), 2U);
  }
}

}  // namespace
}  // namespace shelfbeam::detail
