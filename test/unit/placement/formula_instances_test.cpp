#include "unit/placement/formula_instances.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/bound/lp_bound.hpp"
#include "shelfbeam/placement/reduce/reductions.hpp"

namespace shelfbeam {
namespace {

using test::covering;

struct Size {
  std::string name;
  SignalTable table;
  std::size_t rows, columns;
  std::size_t row_degree;     ///< 0: differs
  std::size_t column_degree;  ///< equal for all columns
};

TEST(FormulaInstances, HaveTheKnownSizesAndDegrees) {
  const Size sizes[] = {
      {"A9", test::affine_lines(2), 12, 9, 3, 4},      {"A27", test::affine_lines(3), 117, 27, 3, 13},
      {"A81", test::affine_lines(4), 1080, 81, 3, 40}, {"CYC06", test::cube_cycles(6), 240, 192, 4, 5},
      {"CYC07", test::cube_cycles(7), 672, 448, 4, 6}, {"CLR10", test::colourings(10, 4), 511, 210, 0, 63}};
  for (const Size& size : sizes) {
    SCOPED_TRACE(size.name);
    EXPECT_EQ(size.table.rows(), size.rows);
    EXPECT_EQ(size.table.columns(), size.columns);
    std::vector<std::size_t> degree(size.columns, 0);
    for (std::size_t i = 0; i < size.table.rows(); ++i) {
      EXPECT_EQ(size.table.row(i).size(), size.row_degree == 0 ? size.table.row(i).size() : size.row_degree);
      for (const SignalEntry& entry : size.table.row(i)) {
        ASSERT_EQ(entry.signal, 1);
        ++degree[entry.transceiver];
      }
    }
    EXPECT_EQ(std::count(degree.begin(), degree.end(), size.column_degree),
              static_cast<std::ptrdiff_t>(size.columns));
  }
}

TEST(FormulaInstances, HaveTheKnownOptima) {
  const std::pair<SignalTable, std::size_t> known[] = {
      {test::affine_lines(2), 5}, {test::affine_lines(3), 18}, {test::cube_cycles(3), 3},
      {test::cube_cycles(4), 8},  {test::colourings(3, 2), 3}, {test::colourings(6, 3), 10},
      {test::colourings(7, 3), 7}};
  for (const auto& [table, optimum] : known) {
    SCOPED_TRACE(table.rows());
    const Placement placement = place(table, covering, {});
    EXPECT_EQ(placement.status, Status::optimal);
    EXPECT_EQ(placement.count(), optimum);
  }
}

// The instances cannot be reduced, and their LP bounds follow from symmetry: columns over row degree.
TEST(FormulaInstances, AreNeitherReducedNorBoundedWell) {
  const std::pair<SignalTable, double> known[] = {{test::affine_lines(4), 27}, {test::cube_cycles(6), 48}};
  for (const auto& [table, bound] : known) {
    const std::vector<double> cost(table.columns(), 1.0);
    const detail::Reduction reduction = detail::reduce_cover({table, covering}, cost);
    ASSERT_EQ(reduction.parts.size(), 1U);
    EXPECT_EQ(reduction.parts[0].labels.size(), table.rows());
    EXPECT_EQ(reduction.parts[0].columns.size(), table.columns());
    const detail::LpBound lp = detail::lp_bound({table, covering}, cost, milp::backends().front(), {}, {});
    EXPECT_NEAR(lp.dual.bound, bound, 1e-6);
  }
}

}  // namespace
}  // namespace shelfbeam
