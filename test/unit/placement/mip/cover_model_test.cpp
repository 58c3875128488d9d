#include "shelfbeam/placement/mip/cover_model.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "unit/placement/random_table.hpp"

namespace shelfbeam::detail {
namespace {

using milp::Result;
using milp::Termination;

/// A solver that returns these results, repeating the last one, and records the models.
struct Script {
  std::vector<Result> answers;
  std::vector<milp::Model> asked = {};

  milp::SolveFunction function() {
    return [this](const milp::Model& model, const milp::SolveOptions&, const RunControl&) {
      asked.push_back(model);
      return answers[std::min(asked.size(), answers.size()) - 1];
    };
  }
};

const std::vector<double> ones(3, 1.0), weights(2, 1.0);

// Unit 0 misses label 0 by less than solvers tolerate, unit 1 reaches it, unit 2 both labels.
SignalTable nearly_met() {
  return test::make_table({{1 - 5e-8, 1, 1}, {1, 0, 1}}, 3);
}

CoverModel::Outcome minimise(Script& script, const MipGoal& goal, const MipKnowledge& knowledge = {}) {
  const SignalTable table = nearly_met();
  const Instance instance(table, {});
  CoverModel model(instance, script.function(), {}, {}, knowledge, weights);
  return model.minimise(goal);
}

// Columns are the units, then u_i of the labels.
const std::vector<double> mistaken = {1, 0, 0, 0, 0}, both = {0, 0, 1, 0, 0}, missed = {1, 0, 0, 1, 0};

TEST(CoverModel, CutsOffALabelThatTheSolverMistakes) {
  Script script{{{Termination::optimal, 1, 1, mistaken}, {Termination::optimal, 1, 1, both}}};
  const auto found = minimise(script, {.cost = ones, .max_missed = 0.5});
  EXPECT_EQ(found.selected, Selection{2});
  EXPECT_FALSE(found.failed);
  ASSERT_EQ(script.asked.size(), 2U);
  const milp::Row& cut = script.asked[1].rows[script.asked[0].rows.size() - 1];
  const std::vector<milp::Entry> expected{{1, 1.0}, {2, 1.0}, {3, 1.0}};
  ASSERT_EQ(cut.entries.size(), expected.size()) << "another unit, or the label is missed";
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(cut.entries[k].column, expected[k].column);
}

TEST(CoverModel, ForbidsMissesThatOnlyTheSolverAllows) {
  const MipGoal goal{.cost = ones, .max_missed = 1 - 1e-8};  // within the tolerance of the solver
  Script script{{{Termination::optimal, 1, 1, missed}, {Termination::optimal, 1, 1, both}}};
  EXPECT_EQ(minimise(script, goal).selected, Selection{2});
  Script once{{{Termination::optimal, 1, 1, missed}}};
  EXPECT_EQ(minimise(once, {.cost = ones, .max_missed = 1}).selected, Selection{0})
      << "control: it may miss one";
}

TEST(CoverModel, KeepsTheBestSelectionOfAllRounds) {
  Script script{{{Termination::optimal, 1, 1, mistaken}, {Termination::limit, 3, 1, {1, 1, 1, 0, 0}}}};
  const auto found = minimise(script, {.cost = ones, .max_missed = 1});
  EXPECT_EQ(found.selected, Selection{0}) << "one unit that misses a label, before three that miss none";
  Script worse{{{Termination::limit, 3, 1, {1, 1, 1, 0, 0}}}};
  EXPECT_EQ(minimise(worse, {.cost = ones, .max_missed = 1}).selected, (Selection{0, 1, 2}));
}

TEST(CoverModel, TakesAnEmptyModelForABoundAtTheCutOff) {
  for (const bool is_safe : {true, false}) {
    Script script{{{Termination::infeasible, milp::infinity, -milp::infinity, {}, is_safe}}};
    const auto found = minimise(script, {.cost = ones, .max_missed = 1}, {.cutoff = 2});
    EXPECT_EQ(found.infeasible, is_safe);
    EXPECT_NEAR(found.bound, 2, 1e-5);
    EXPECT_EQ(found.bound < 2, !is_safe);
  }
}

// With unit failure, u_i fills the row of K / (K - 1) exactly.
TEST(CoverModel, FillsRowsOfMissedLabels) {
  const SignalTable table = test::make_table({{1, 1, 1}, {1, 1, 1}}, 3);
  const Instance instance(table, {.redundant = true});
  Script script{{{Termination::optimal, 0, 0, {0, 0, 0, 1, 1}}}};
  CoverModel model(instance, script.function(), {}, {}, {}, weights);
  const auto found = model.minimise({.cost = ones, .price_of_misses = 1});
  EXPECT_EQ(found.selected, Selection{});
  const milp::Row& row = script.asked.front().rows.front();
  EXPECT_NEAR(row.lower, 1.5, 1e-5);
  EXPECT_EQ(row.entries.back().value, row.lower);
}

}  // namespace
}  // namespace shelfbeam::detail
