#include "shelfbeam/milp/solver.hpp"

#include <atomic>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "support/processor_time.hpp"
#include "unit/milp/every_backend.hpp"
#include "unit/milp/example_models.hpp"

namespace shelfbeam::milp {
namespace {

class MilpSolver : public testing::TestWithParam<Backend> {
 protected:
  static Result solve(const Model& model, const SolveOptions& options = {}, const RunControl& control = {}) {
    return GetParam().solve(model, options, control);
  }
};

INSTANTIATE_TEST_SUITE_P(Every, MilpSolver, test::every_backend, test::backend_name);

// Data are exact and small, so solvers must agree with enumeration within their relative gap of 1e-6.
TEST_P(MilpSolver, EqualsEnumerationOnRandomModels) {
  std::mt19937_64 random(7);
  int infeasible = 0;
  int control = 0;
  for (int k = 0; k < 300; ++k) {
    const Model model = test::random_model(random);
    const double expected = test::try_everything(model);
    const Result result = solve(model);
    if (expected == infinity) {
      ++infeasible;
      EXPECT_EQ(result.termination, Termination::infeasible) << k;
      continue;
    }
    ASSERT_EQ(result.termination, Termination::optimal) << k;
    EXPECT_NEAR(result.primal_bound, expected, 1e-6 * std::max(1.0, std::abs(expected))) << k;
    EXPECT_NEAR(result.dual_bound, expected, 1e-5 * std::max(1.0, std::abs(expected))) << k;
    // Negative control: some models must have another optimum without their last row.
    Model relaxed = model;
    if (!relaxed.rows.empty()) relaxed.rows.pop_back();
    if (test::try_everything(relaxed) < expected - 1e-3) ++control;
  }
  EXPECT_GT(infeasible, 20);
  EXPECT_GT(control, 20);
}

TEST_P(MilpSolver, SolvesModelsOfEveryKind) {
  Model relaxed = test::triangle(), impossible = test::triangle(), fixed = test::triangle(), no_rows,
        no_columns;
  for (Column& column : relaxed.columns) column.integer = false;
  impossible.rows.push_back({1.0, infinity, {}, "nobody reaches it"});
  fixed.columns[0].cost = 100;
  fixed.columns[0].lower = 1;
  no_rows.columns = {{2, 0, 1, true, "a"}, {-3, 0, 1, true, "b"}, {1, 1, 1, true, "c"}};
  no_columns.rows.push_back({1.0, infinity, {}, "label"});
  const std::pair<Model, double> models[] = {
      {test::triangle(), 2},  {relaxed, 1.5}, {impossible, infinity}, {fixed, 101}, {no_rows, -2},
      {no_columns, infinity}, {{}, 0}};
  for (const auto& [model, value] : models) {
    SCOPED_TRACE(value);
    const Result result = solve(model);
    EXPECT_EQ(result.termination, value == infinity ? Termination::infeasible : Termination::optimal);
    EXPECT_TRUE(value < infinity || result.solution.empty());
    if (value == infinity) continue;
    EXPECT_NEAR(result.primal_bound, value, 1e-9);
    EXPECT_NEAR(result.dual_bound, value, 1e-9);
  }
  EXPECT_EQ(solve(no_rows).solution, (std::vector<double>{0, 1, 1}));
}

// Absolute tolerances of solvers are between 1e-5 and 1e-10; costs far below and above must be distinguished.
TEST_P(MilpSolver, DistinguishesCostsAtAnyScale) {
  for (const double unit : {1e-12, 1e-6, 1.0, 1e7, 1e12}) {
    Model model = test::triangle();
    model.columns[0].cost = 1.25 * unit;
    model.columns[1].cost = 1.251 * unit;
    model.columns[2].cost = 1.252 * unit;
    const Result result = solve(model);
    EXPECT_EQ(result.termination, Termination::optimal) << unit;
    EXPECT_EQ(result.solution, (std::vector<double>{1, 1, 0})) << unit;
    EXPECT_NEAR(result.primal_bound / unit, 2.501, 1e-9) << unit;
    EXPECT_NEAR(result.dual_bound / unit, 2.501, 1e-5) << unit;
  }
}

// A81 cannot be proven in this time; its optimum, 61, must be between the bounds.
TEST_P(MilpSolver, StopsAtTheTimeLimitWithHonestBounds) {
  for (const double limit : {1.0, 0.0, -1.0, 1e-9}) {
    const test::ProcessorTime spent;
    const Result result = solve(test::steiner_81(), {.time_limit_s = limit}, {.threads = 1});
    EXPECT_LT(spent.seconds(), 20);
    EXPECT_EQ(result.termination, Termination::limit);
    EXPECT_GE(result.primal_bound, 61);
    EXPECT_LE(result.dual_bound, 61);
  }
}

TEST_P(MilpSolver, StopsAtTheNodeLimitWithHonestBounds) {
  const SolveOptions limited{.node_limit = 10};
  const RunControl control{.threads = 1};
  const Result result = solve(test::steiner(27), limited, control);
  EXPECT_EQ(result.termination, Termination::limit);
  EXPECT_GE(result.primal_bound, 18);
  EXPECT_LT(result.dual_bound, 18);
  EXPECT_GE(result.dual_bound, 9);  // the LP bound, 27 / 3
  const Result again = solve(test::steiner(27), limited, control);
  EXPECT_EQ(again.solution, result.solution) << "the same work, the same outcome";
  EXPECT_EQ(again.dual_bound, result.dual_bound);
  EXPECT_EQ(solve(test::triangle(), limited, control).termination, Termination::optimal);
}

class CancelOnReport final : public ProgressSink {
 public:
  void report(Task, double, std::string_view detail) override {
    ++reports;
    last = detail;
    if (reports == 2) token.request();
  }
  CancelToken token;
  std::atomic<int> reports{0};
  std::string last;
};

TEST_P(MilpSolver, ReportsBoundsAndCanBeCancelled) {
  CancelOnReport sink;
  const RunControl control{.threads = 1, .cancel = &sink.token, .progress = &sink};
  const Result result = solve(test::steiner_81(), {}, control);
  EXPECT_EQ(result.termination, Termination::interrupted);
  EXPECT_GE(sink.reports, 2);
  EXPECT_NE(sink.last.find("bound"), std::string::npos) << sink.last;
  EXPECT_GE(result.primal_bound, 61);
  EXPECT_LE(result.dual_bound, 61);
}

TEST_P(MilpSolver, DoesNothingOnceCancelled) {
  CancelToken token;
  token.request();
  const Result result = solve(test::triangle(), {}, {.cancel = &token});
  EXPECT_EQ(result.termination, Termination::interrupted);
  EXPECT_TRUE(result.solution.empty());
}

TEST_P(MilpSolver, IsSilent) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  solve(test::triangle());
  solve(test::steiner(27), {.node_limit = 10});
  Model impossible = test::triangle();
  impossible.rows.push_back({5.0, infinity, {{0, 1.0}}, {}});
  solve(impossible);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST_P(MilpSolver, AcceptsAnotherNumberOfThreadsEachTime) {
  for (const unsigned threads : {1U, 2U, 1U, 3U})
    EXPECT_EQ(solve(test::triangle(), {}, {.threads = threads}).primal_bound, 2) << threads;
}

}  // namespace
}  // namespace shelfbeam::milp
