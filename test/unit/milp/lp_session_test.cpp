#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"

#include "unit/milp/every_backend.hpp"
#include "unit/milp/example_models.hpp"

namespace shelfbeam::milp {
namespace {

class MilpLpSession : public testing::TestWithParam<Backend> {
 protected:
  static std::unique_ptr<LpSession> session(const std::vector<Column>& columns) {
    return GetParam().lp(columns);
  }
};

INSTANTIATE_TEST_SUITE_P(Every, MilpLpSession, test::every_backend, test::backend_name);

/// The Lagrangian bound of any duals: no x within the columns' bounds that satisfies the rows costs less.
/// Columns must be bounded.
double dual_objective(const Model& model, const std::vector<double>& y) {
  double sum = 0;
  std::vector<double> reduced;
  for (const Column& column : model.columns) reduced.push_back(column.cost);
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    const Row& row = model.rows[i];
    if (y[i] != 0) sum += y[i] * (y[i] > 0 ? row.lower : row.upper);
    for (const Entry& entry : row.entries) reduced[entry.column] -= y[i] * entry.value;
  }
  for (std::size_t j = 0; j < reduced.size(); ++j)
    sum += std::min(reduced[j] * model.columns[j].lower, reduced[j] * model.columns[j].upper);
  return sum;
}

void make_continuous(Model& model) {
  for (Column& column : model.columns) column.integer = false;
}

/// Rows of every sense over columns in [0, 1] or other bounds; may be infeasible.
Model random_lp(std::mt19937_64& random) {
  const auto real = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  Model model;
  const auto columns = std::uniform_int_distribution<std::uint32_t>(1, 30)(random);
  for (std::uint32_t j = 0; j < columns; ++j) {
    const double low = real(-1, 1);
    model.columns.push_back({real(-1, 3), low, low + real(0, 2), false, {}});
  }
  for (int i = std::uniform_int_distribution(1, 25)(random); i > 0; --i) {
    Row row;
    for (std::uint32_t j = 0; j < columns; ++j)
      if (real(0, 1) < 0.5) row.entries.push_back({j, real(-0.3, 1)});
    const double bound = real(-1, 1);
    const double sense = real(0, 1);
    if (sense < 0.8) row.lower = bound;
    if (sense > 0.6) row.upper = bound + (sense > 0.9 ? 0 : 0.5);
    model.rows.push_back(std::move(row));
  }
  return model;
}

void expect_optimum(const Model& model, const LpResult& result) {
  ASSERT_EQ(result.x.size(), model.columns.size());
  ASSERT_EQ(result.y.size(), model.rows.size());
  EXPECT_LE(violation(model, result.x), 1e-7);
  EXPECT_NEAR(objective(model, result.x), result.objective, 1e-7);
  for (std::size_t i = 0; i < model.rows.size(); ++i) {
    EXPECT_LE(result.y[i], model.rows[i].lower == -infinity ? 1e-7 : infinity);
    EXPECT_GE(result.y[i], model.rows[i].upper == infinity ? -1e-7 : -infinity);
  }
}

/// Duals restricted to the sign that their row allows.
std::vector<double> clipped(const Model& model, std::vector<double> y) {
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (model.rows[i].lower == -infinity) y[i] = std::min(y[i], 0.0);
    if (model.rows[i].upper == infinity) y[i] = std::max(y[i], 0.0);
  }
  return y;
}

// The bound of the duals is equal to the solution's value, so both are optimal, independently of the solver,
// after every added row.
TEST_P(MilpLpSession, DualsProveTheOptimum) {
  std::mt19937_64 random(3);
  int solved = 0, infeasible = 0, changed = 0, wrong_sign = 0;
  for (int k = 0; k < 150; ++k) {
    Model model = random_lp(random);
    const std::vector<Row> rows = std::move(model.rows);
    model.rows.clear();
    const auto lp = session(model.columns);
    double last = lp->solve(infinity, {}).objective;
    for (const Row& row : rows) {
      SCOPED_TRACE(testing::Message() << k << ", row " << model.rows.size());
      model.rows.push_back(row);
      lp->add_rows({&row, 1});
      const LpResult result = lp->solve(infinity, {});
      if (result.termination == Termination::infeasible) {
        ++infeasible;
        EXPECT_EQ(GetParam().solve(model, {}, {}).termination, Termination::infeasible);
        EXPECT_TRUE(result.x.empty());
        break;
      }
      ASSERT_EQ(result.termination, Termination::optimal);
      ++solved;
      expect_optimum(model, result);
      EXPECT_NEAR(dual_objective(model, clipped(model, result.y)), result.objective, 1e-7);
      changed += std::abs(result.objective - last) > 1e-3;
      last = result.objective;

      // Negative control: duals of the other sign prove another bound.
      std::vector<double> flipped = result.y;
      for (double& dual : flipped) dual = -dual;
      wrong_sign += std::abs(dual_objective(model, flipped) - result.objective) > 1e-6;
    }
  }
  EXPECT_GT(solved, 300);
  EXPECT_GT(infeasible, 20);
  EXPECT_GT(changed, 100);
  EXPECT_GT(wrong_sign, solved / 3);
}

TEST_P(MilpLpSession, SolvesWithoutRows) {
  const auto lp = session({{2, 0, 1, true, {}}, {-3, 0, 1, true, {}}});
  const LpResult result = lp->solve(infinity, {});
  EXPECT_EQ(result.termination, Termination::optimal);
  EXPECT_EQ(result.x, (std::vector<double>{0, 1}));
  EXPECT_EQ(result.objective, -3);
  EXPECT_TRUE(result.y.empty());
}

TEST_P(MilpLpSession, DistinguishesCostsAtAnyScale) {
  for (const double unit : {1e-12, 1e-6, 1.0, 1e7, 1e12}) {
    Model model = test::triangle();
    make_continuous(model);
    for (Column& column : model.columns) column.cost = 1.1 * unit;
    model.columns[1].cost = 1.101 * unit;
    const auto lp = session(model.columns);
    lp->add_rows(model.rows);
    const LpResult result = lp->solve(infinity, {});
    ASSERT_EQ(result.termination, Termination::optimal) << unit;
    EXPECT_NEAR(result.objective / unit, 1.6505, 1e-7) << unit;
    EXPECT_NEAR(dual_objective(model, result.y) / unit, 1.6505, 1e-7) << unit;
  }
}

TEST_P(MilpLpSession, ContinuesAfterAStop) {
  Model model = test::steiner_81();
  make_continuous(model);
  const auto lp = session(model.columns);
  lp->add_rows(model.rows);
  const LpResult stopped = lp->solve(0, {});
  EXPECT_EQ(stopped.termination, Termination::limit);
  EXPECT_TRUE(stopped.x.empty());
  CancelToken token;
  token.request();
  EXPECT_EQ(lp->solve(60, {.cancel = &token}).termination, Termination::interrupted);
  const LpResult result = lp->solve(60, {});
  EXPECT_EQ(result.termination, Termination::optimal);
  EXPECT_NEAR(result.objective, 27, 1e-7);
  // The limit applies to each solve, not to all together.
  for (int k = 0; k < 50; ++k) EXPECT_EQ(lp->solve(1, {}).termination, Termination::optimal);
}

TEST_P(MilpLpSession, IsSilentAndLivesBesideOthers) {
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Model model = test::triangle();
  const auto a = session(model.columns);
  const auto b = session(model.columns);
  a->add_rows(model.rows);
  b->add_rows({model.rows.data(), 1});
  EXPECT_NEAR(a->solve(infinity, {}).objective, 1.5, 1e-9);
  EXPECT_NEAR(b->solve(infinity, {}).objective, 1, 1e-9);
  EXPECT_EQ(GetParam().solve(model, {}, {.threads = 2}).primal_bound, 2);
  EXPECT_NEAR(a->solve(infinity, {}).objective, 1.5, 1e-9);
  const Row impossible{5, infinity, {{0, 1.0}}, {}};
  a->add_rows({&impossible, 1});
  EXPECT_EQ(a->solve(infinity, {}).termination, Termination::infeasible);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace shelfbeam::milp
