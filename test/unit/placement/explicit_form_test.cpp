#include <cmath>

#include <gtest/gtest.h>

#include "shelfbeam/milp/solver.hpp"
#include "shelfbeam/placement/answer/placement.hpp"

#include "unit/placement/random_table.hpp"

namespace shelfbeam {
namespace {

/// A dense matrix with the operations of the paper's notation.
struct Matrix {
  std::size_t rows, columns;
  std::vector<double> values;

  Matrix(std::size_t r, std::size_t c) : rows(r), columns(c), values(r * c, 0.0) {}
  double& operator()(std::size_t i, std::size_t j) { return values[i * columns + j]; }
  double operator()(std::size_t i, std::size_t j) const { return values[i * columns + j]; }
};

Matrix filled(std::size_t r, std::size_t c, double value) {
  Matrix result(r, c);
  for (double& entry : result.values) entry = value;
  return result;
}

Matrix identity(std::size_t n) {
  Matrix result(n, n);
  for (std::size_t i = 0; i < n; ++i) result(i, i) = 1;
  return result;
}

/// (factor I_m  column)
Matrix identity_beside(std::size_t m, double factor, double column) {
  Matrix result(m, m + 1);
  for (std::size_t i = 0; i < m; ++i) result(i, i) = factor, result(i, m) = column;
  return result;
}

Matrix kronecker(const Matrix& a, const Matrix& b) {
  Matrix result(a.rows * b.rows, a.columns * b.columns);
  for (std::size_t i = 0; i < result.rows; ++i)
    for (std::size_t j = 0; j < result.columns; ++j)
      result(i, j) = a(i / b.rows, j / b.columns) * b(i % b.rows, j % b.columns);
  return result;
}

Matrix hadamard(Matrix a, const Matrix& b) {
  for (std::size_t k = 0; k < a.values.size(); ++k) a.values[k] *= b.values[k];
  return a;
}

enum class Form { complete, without_equalities };

/// (3.11)-(3.14) as printed, x = (t_11, ..., t_1n, ..., t_mn, T_1, ..., T_n); the rows A x >= gamma tau are
/// divided by their requirement only. Beside the paper's, a row for every mounting point with options.
milp::Model explicit_model(const SignalTable& table, const std::vector<double>& link_cost,
                           const std::vector<double>& delta, Form form) {
  const std::size_t m = table.rows(), n = table.columns();
  Matrix signal(m, n);
  for (std::size_t i = 0; i < m; ++i)
    for (const SignalEntry& entry : table.row(i)) signal(i, entry.transceiver) = entry.signal;
  const Matrix a =
      hadamard(kronecker(identity_beside(m, 1, 0), filled(1, n, 1)), kronecker(filled(1, m + 1, 1), signal));
  const Matrix equal = kronecker(identity_beside(m, -1, 1), identity(n));

  milp::Model model;
  for (std::size_t k = 0; k < m * n; ++k) model.columns.push_back({link_cost[k / n], 0, 1, true, {}});
  for (std::size_t j = 0; j < n; ++j) {
    double cost = table.transceivers[j].cost;
    for (std::size_t i = 0; i < m; ++i) cost += signal(i, j) * delta[i];
    model.columns.push_back({cost, table.transceivers[j].installed ? 1.0 : 0.0, 1, true, {}});
  }
  const auto add = [&](const Matrix& matrix, std::size_t row, double divisor, double lower, double upper) {
    milp::Row built{lower, upper, {}, {}};
    for (std::uint32_t k = 0; k < matrix.columns; ++k)
      if (matrix(row, k) != 0) built.entries.push_back({k, matrix(row, k) / divisor});
    model.rows.push_back(std::move(built));
  };
  for (std::size_t i = 0; i < m; ++i)
    add(a, i, table.labels[i].requirement, 1 - met_tolerance, milp::infinity);
  if (form == Form::complete)
    for (std::size_t r = 0; r < m * n; ++r) add(equal, r, 1, 0, 0);
  for (const auto& mount : table.mounts) {
    milp::Row row{-milp::infinity, 1, {}, {}};
    for (const std::uint32_t j : mount) row.entries.push_back({static_cast<std::uint32_t>(m * n) + j, 1});
    model.rows.push_back(std::move(row));
  }
  return model;
}

TEST(PlacementExplicitForm, HasTheSameOptimumAsTheEliminatedOne) {
  test::RandomTables plain(31, {.labels = 5, .transceivers = 7, .borderline = false});
  test::RandomTables with_options(32, {.labels = 5, .transceivers = 7, .borderline = false, .mounts = true});
  int feasible = 0, control = 0;
  for (int k = 0; k < 900; ++k) {
    SCOPED_TRACE(k);
    test::RandomTables& tables = k < 600 ? plain : with_options;
    const SignalTable table = tables.next();
    PlacementProblem problem = tables.next_problem();
    problem.model = CommunicationModel::cooperative;
    problem.combination = Combination::weighted;
    if (problem.objective == Objective::effective_links) problem.objective = Objective::links;
    const Placement eliminated = place(table, problem, {});

    const std::vector<double> none(table.rows(), 0.0);
    const std::vector<double> cost = label_costs(table, problem.objective).cost;
    const bool links = problem.objective == Objective::links;
    const auto value = [&](Form form) {
      const auto model = explicit_model(table, links ? cost : none, links ? none : cost, form);
      return milp::backends().front().solve(model, {}, {});
    };
    const milp::Result result = value(Form::complete);
    if (eliminated.status == Status::infeasible) {
      EXPECT_EQ(result.termination, milp::Termination::infeasible);
      continue;
    }
    ++feasible;
    ASSERT_EQ(result.termination, milp::Termination::optimal);
    // Both optima are proven within a relative gap of 1e-6.
    const double tolerance = 2e-6 * std::max(eliminated.objective_value, result.primal_bound);
    EXPECT_NEAR(result.primal_bound, eliminated.objective_value, tolerance);
    // Negative control: without t_ij = T_j links can be chosen freely.
    const double relaxed = value(Form::without_equalities).primal_bound;
    control += std::abs(relaxed - eliminated.objective_value) > 10 * tolerance;
  }
  EXPECT_GT(feasible, 300);
  EXPECT_GT(control, 100);
}

}  // namespace
}  // namespace shelfbeam
