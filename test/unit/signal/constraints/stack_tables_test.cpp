#include "shelfbeam/signal/constraints/stack_tables.hpp"

#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

NamedTable scenario(const std::string& name, const SignalMatrix& matrix) {
  return {name, name + ".h5", make_signal_table(matrix)};
}

/// The same matrix with its columns in reverse order.
SignalMatrix reversed(SignalMatrix matrix) {
  std::reverse(matrix.transceivers.begin(), matrix.transceivers.end());
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    const auto begin = matrix.mean.begin() + static_cast<std::ptrdiff_t>(i * matrix.columns());
    std::reverse(begin, begin + static_cast<std::ptrdiff_t>(matrix.columns()));
  }
  return matrix;
}

TEST(StackTables, KeepsASingleTableUnchanged) {
  const SignalTable table = stack_tables({scenario("open", small_matrix())});
  EXPECT_EQ(table.labels[0].id, "A1-front-0");
  EXPECT_TRUE(table.scenarios.empty());
}

TEST(StackTables, AppendsRows) {
  SignalMatrix few = small_matrix(3);
  for (float& value : few.mean) value *= 0.5F;
  const SignalTable first = make_signal_table(small_matrix());
  const SignalTable second = make_signal_table(few);
  const SignalTable table = stack_tables({scenario("open", small_matrix()), scenario("shut", reversed(few))});
  ASSERT_EQ(table.rows(), 10U);
  ASSERT_EQ(table.columns(), 5U);
  EXPECT_EQ(table.labels[2].id, "open:A1-front-2");
  EXPECT_EQ(table.labels[9].id, "shut:A1-front-2");
  EXPECT_EQ(table.labels[9].link_cost, second.labels[2].link_cost);
  ASSERT_EQ(table.scenarios.size(), 2U);
  EXPECT_EQ(table.scenarios[1].name, "shut");
  EXPECT_EQ(table.scenarios[1].first, 7U);
  EXPECT_EQ(table.scenarios[1].labels, 3U);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto expected = i < 7 ? first.row(i) : second.row(i - 7);
    const auto row = table.row(i);
    ASSERT_EQ(row.size(), expected.size()) << i;
    for (std::size_t k = 0; k < row.size(); ++k) {
      EXPECT_EQ(row[k].transceiver, expected[k].transceiver);
      EXPECT_EQ(row[k].signal, expected[k].signal);
    }
  }
}

TEST(StackTables, KeepsPositionsKnownToOneFile) {
  SignalMatrix matrix = small_matrix();
  matrix.transceivers[3].position = matrix.transceivers[0].position;
  NamedTable blind = scenario("blind", matrix);
  blind.table.mounts.clear();
  for (auto& unit : blind.table.transceivers) unit.position.reset();
  const SignalTable table = stack_tables({blind, scenario("open", reversed(matrix))});
  EXPECT_EQ(table.mounts, (std::vector<std::vector<ColumnId>>{{0, 3}}));
  EXPECT_EQ(table.transceivers[1].position, matrix.transceivers[1].position);
}

TEST(StackTables, RefusesInconsistentTables) {
  const SignalMatrix matrix = small_matrix();
  const auto refused = [&](const SignalMatrix& other, std::string_view problem) {
    const auto stack = [&] { stack_tables({scenario("open", matrix), scenario("shut", other)}); };
    expect_input_error(stack, "shut.h5", "open.h5", problem);
  };
  SignalMatrix other = matrix;
  other.transceivers[2].id = "new";
  refused(other, "'new'");
  refused(small_matrix(7, 4), "'G1-4-0'");
  other = matrix;
  other.transceivers[1].cost = 7;
  refused(other, "'G1-1-0' costs 7");
  other = matrix;
  other.transceivers[1].installed = true;
  refused(other, "'G1-1-0' is installed");
  other = matrix;
  other.transceivers[4].position.z -= 0.001;
  refused(other, "'G1-4-0'");
  const NamedTable again{"open", "other/open.h5", make_signal_table(matrix)};
  expect_input_error([&] { stack_tables({scenario("open", matrix), again}); }, "other/open.h5", "'open'");
}

}  // namespace
}  // namespace shelfbeam::test
