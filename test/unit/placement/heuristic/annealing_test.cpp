#include "shelfbeam/placement/heuristic/annealing.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "shelfbeam/placement/heuristic/greedy.hpp"
#include "shelfbeam/placement/kernels/similar_columns.hpp"
#include "shelfbeam/placement/problem/checker.hpp"

#include "unit/placement/brute_force.hpp"
#include "unit/placement/random_table.hpp"

namespace shelfbeam::detail {
namespace {

using Columns = std::vector<std::uint32_t>;

// From all that may be chosen together and from the greedy selection: never anything but an answer, with what
// is installed, the same for any number of threads, and nearly always one of the fewest units.
TEST(Annealing, FindsValidAndMostlyTheFewest) {
  test::RandomTables random(3, {.labels = 12, .transceivers = 11, .mounts = true, .apart = true});
  int started = 0, could_gain = 0, gained = 0, best = 0;
  for (int k = 0; k < 1500; ++k) {
    SCOPED_TRACE(testing::Message() << "case " << k);
    const SignalTable table = random.next();
    const Question question;
    const SearchProblem problem(table, question);
    const SearchMatrix all(table, question.model);
    const auto answers = test::BruteForce::answers(table, question);
    if (answers.empty()) continue;
    const Columns& start =
        answers[static_cast<std::size_t>(random.whole(0, static_cast<int>(answers.size()) - 1))].columns;
    const SearchEffort effort{.moves = 3000, .walks = 3};
    const auto found = anneal(problem, all, start, effort, {.threads = 1});
    for (const unsigned threads : {2U, 4U})
      ASSERT_EQ(anneal(problem, all, start, effort, {.threads = threads}), found);
    std::size_t fewest = start.size();
    for (const auto& answer : answers) fewest = std::min(fewest, answer.columns.size());
    ++started;
    could_gain += fewest < start.size();
    best += found.value_or(start).size() == fewest;
    if (!found) continue;
    ++gained;
    ASSERT_TRUE(std::is_sorted(found->begin(), found->end()));
    ASSERT_LT(found->size(), start.size());
    ASSERT_TRUE(check_selection(table, question, *found).met());
    ASSERT_TRUE(
        std::includes(found->begin(), found->end(), problem.installed.begin(), problem.installed.end()));
    ASSERT_TRUE(std::any_of(answers.begin(), answers.end(),
                            [&](const auto& answer) { return answer.columns == *found; }));
  }
  EXPECT_GT(could_gain, 200);
  EXPECT_GT(gained, could_gain * 9 / 10);
  EXPECT_GT(best, started * 95 / 100);
}

TEST(Annealing, LeavesOtherQuestionsAlone) {
  const SignalTable table = test::make_table({{1, 1}}, 2);
  for (const Question& question :
       {Question{.model = CommunicationModel::non_cooperative},
        Question{.combination = Combination::weighted}, Question{.redundant = true}}) {
    const SearchProblem problem(table, question);
    EXPECT_FALSE(can_anneal(question));
    EXPECT_EQ(anneal(problem, SearchMatrix(table, question.model), {0, 1}, {}, {}), std::nullopt);
  }
  const Question question;
  const SearchProblem problem(table, question);
  const auto found = anneal(problem, SearchMatrix(table, question.model), {0, 1}, {}, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->size(), 1U);
}

TEST(Annealing, EndsWhenCancelled) {
  const SignalTable table = test::make_table({{1, 1}}, 2);
  const Question question;
  CancelToken cancel;
  cancel.request();
  const SearchEffort endless{.moves = std::numeric_limits<std::uint64_t>::max()};
  EXPECT_EQ(anneal(SearchProblem(table, question), SearchMatrix(table, question.model), {0, 1}, endless,
                   {.cancel = &cancel}),
            std::nullopt);
}

TEST(Annealing, EndsWithoutLabelsWalksAndTime) {
  for (const SignalTable& table :
       {test::make_table({}, 3), test::make_table({}, 0), test::make_table({{1}}, 1)}) {
    const Question question;
    const SearchProblem problem(table, question);
    const SearchMatrix all(table, question.model);
    Columns start(table.columns());
    std::iota(start.begin(), start.end(), 0U);
    EXPECT_EQ(anneal(problem, all, start, {}, {}).value_or(start).size(), table.rows());
    EXPECT_EQ(anneal(problem, all, start, {.walks = 0}, {}), std::nullopt);
    EXPECT_EQ(anneal(problem, all, start, {.until = {}}, {}), std::nullopt);
  }
}

// Sums that single precision takes for met and the rule does not are no answer, and no end either.
TEST(Annealing, GetsPastLabelsThatAreMetInSinglePrecisionOnly) {
  std::vector<std::vector<double>> matrix(600, {1, 0, 1, 0});
  for (std::size_t i = 300; i < matrix.size(); ++i) matrix[i] = {0.5, 0.5 - 5e-9, 0, 1};
  const SignalTable table = test::make_table(matrix, 4);
  const Question question;
  const SearchProblem problem(table, question);
  const auto found = anneal(problem, SearchMatrix(table, question.model), {0, 1, 2, 3}, {.moves = 2000}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(check_selection(table, question, *found).met());
  EXPECT_EQ(found->size(), 2U);
}

#ifdef SHELFBEAM_LARGE_INSTANCES
// One unit fewer than local search ever found.
TEST(AnnealingSlow, FindsTheBestKnownOfTheSupermarket) {
  const SignalTable table = read_signal_table(SHELFBEAM_LARGE_INSTANCES "/super_s1_e0.txt.gz");
  const Question question;
  const SearchProblem problem(table, question);
  const SearchMatrix all(table, question.model);
  const auto found = anneal(problem, all, greedy_selection(table, question), {.moves = 10000000}, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(check_selection(table, question, *found).met());
  EXPECT_EQ(found->size(), 25U);
}
#endif

// Units in a row, each heard by labels near it: the most similar are the neighbours, and of those that may be
// chosen only.
TEST(SimilarColumns, AreNeighboursInARow) {
  constexpr std::size_t n = 100;
  std::vector<std::vector<double>> matrix(n, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const double distance = static_cast<double>(i) - static_cast<double>(j);
      matrix[i][j] = 1 / (1 + distance * distance / 10);
    }
  const SignalTable table = test::make_table(matrix, n);
  Columns candidates;
  for (std::uint32_t j = 0; j < n; ++j)
    if (j != 51) candidates.push_back(j);
  SimilarColumns similar(SearchMatrix(table, CommunicationModel::cooperative), candidates);
  const auto near = similar.to(50);
  ASSERT_EQ(near.size(), 60U);
  EXPECT_EQ(near[0], 49U);
  EXPECT_EQ(near[1] + near[2], 48U + 52U);
  EXPECT_EQ(std::count(near.begin(), near.end(), 50U) + std::count(near.begin(), near.end(), 51U), 0);
}

}  // namespace
}  // namespace shelfbeam::detail
