#include "shelfbeam/signal/tables/table_reading.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using Rows = std::vector<std::set<std::uint32_t>>;

Rows rows_of(const SignalTable& table) {
  Rows rows(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    std::int64_t last = -1;
    for (const SignalEntry& entry : table.row(i)) {
      EXPECT_EQ(entry.signal, 1);
      EXPECT_GT(entry.transceiver, last) << "entries must be in column order";
      last = entry.transceiver;
      rows[i].insert(entry.transceiver);
    }
  }
  return rows;
}

TEST(OrLibrary, ReadsScpWithWrappedLines) {
  const TempFolder folder;
  const auto table =
      read_signal_table(folder.write("scp.txt", " 3 4 \n 1 2\n 3 4\n 2\n 4\n 1 \n3 1 2 3 1\n 2 \n"));
  EXPECT_EQ(rows_of(table), (Rows{{0, 3}, {0, 1, 2}, {1}}));
  for (std::size_t j = 0; j < 4; ++j) EXPECT_EQ(table.transceivers[j].cost, static_cast<double>(j + 1));
  for (const auto& label : table.labels) {
    EXPECT_EQ(label.requirement, 1);
    EXPECT_EQ(label.single_requirement, 1);
  }
}

TEST(OrLibrary, ReadsTheTriangle) {
  // Three rows of two columns each, formatted so that most lines are also valid in a rail file.
  const TempFolder folder;
  const auto table = read_signal_table(folder.write("triangle.txt", "3 3\n1 1 1\n2 1 2\n2 2 3\n2 1 3\n"));
  EXPECT_EQ(rows_of(table), (Rows{{0, 1}, {1, 2}, {0, 2}}));
}

TEST(OrLibrary, FilesThatFitBothFormsAreRefused) {
  const TempFolder folder;
  const auto both = folder.write("both.txt", "2 3\n5 1 1\n2 1 2\n2 1 2\n");
  expect_input_error([&] { read_signal_table(both); }, "both.txt: fits both forms", "'scp' or 'rail'");
  EXPECT_EQ(rows_of(read_table(both, TableReading::scp).table), (Rows{{0, 1}, {0, 1}}));
  EXPECT_EQ(rows_of(read_table(both, TableReading::rail).table), (Rows{{0}, {1, 2}}));
  // Both forms mean the same matrix.
  const auto same = folder.write("same.txt", "1 1\n1 1 1\n");
  EXPECT_EQ(rows_of(read_signal_table(same)), (Rows{{0}}));
  // The other form is not tried if one is chosen.
  expect_input_error([&] { read_table(folder.write("r", "1 2\n1 0\n1 1 1\n"), TableReading::scp); }, "line");
}

TEST(OrLibrary, ReadsRail) {
  const TempFolder folder;
  const auto table = read_signal_table(folder.write("rail.txt", "3 4\n2 2 3 1\n1 1 2\n1 0\n2 1 3"));
  EXPECT_EQ(rows_of(table), (Rows{{0}, {1}, {0, 3}}));
  EXPECT_EQ(table.transceivers[0].cost, 2);
  EXPECT_EQ(table.transceivers[2].cost, 1);
}

TEST(OrLibrary, BothFormsOfRandomInstancesAgree) {
  std::mt19937 random(7);
  const TempFolder folder;
  for (int k = 0; k < 50; ++k) {
    const std::size_t m = 3 + random() % 20, n = 3 + random() % 30;
    Rows rows(m);
    for (auto& row : rows)
      for (std::uint32_t j = 0; j < n; ++j)
        if (random() % 3 == 0) row.insert(j);
    std::string scp = fmt::format("{} {}\n", m, n), rail = scp;
    for (std::size_t j = 0; j < n; ++j) scp += fmt::format("{}{}", 10 + j, j % 12 == 11 ? "\n" : " ");
    for (const auto& row : rows) {
      scp += fmt::format("\n{}\n", row.size());
      for (const std::uint32_t j : row) scp += fmt::format("{} ", j + 1);
    }
    for (std::uint32_t j = 0; j < n; ++j) {
      std::string covered;
      std::size_t count = 0;
      for (std::size_t i = 0; i < m; ++i)
        if (rows[i].contains(j)) covered += fmt::format(" {}", i + 1), ++count;
      rail += fmt::format("{} {}{}\n", 10 + j, count, covered);
    }
    const auto from_scp = read_signal_table(folder.write("scp", scp));
    const auto from_rail = read_signal_table(folder.write("rail", rail));
    EXPECT_EQ(rows_of(from_scp), rows);
    EXPECT_EQ(rows_of(from_rail), rows);
    for (std::size_t j = 0; j < n; ++j)
      EXPECT_EQ(from_scp.transceivers[j].cost, from_rail.transceivers[j].cost);
  }
}

TEST(OrLibrary, BrokenFilesAreRefusedWithPosition) {
  const auto refused = [](std::string_view content, std::string_view place, std::string_view problem) {
    expect_file_refused(read_signal_table, content, place, problem);
  };
  refused("2 4\n1 1 1 1\n2 1 2\n2 1\n", "line 5", "a column number");
  refused("2 4\n1 1 1 1\n2 1 0\n1 1\n", "line 3", "column number is 0");
  refused("2 4\n1 1 1 1\n5 1 2 3 4\n1 1\n", "line 3", "number of columns of a row is 5");
  refused("2 4\n-1 1 1 1\n2 1 2\n1 1\n", "line 2", "negative");
  refused("2 4\n1 1 1 1\n2 1 2\n1 1\n7\n", "line 5", "last row");
  refused("2 4\n1 1 1 1\n2 1 1\n2 1 2\n", "", "column 1 covers row 1");
  refused("2 4\n1 1\n", "line 3", "ends");
  refused("4000000000 3\n1 1 1\n", "line 1", "4000000000");

  // A file that begins as a rail file is read as one.
  refused("9 3\n5 4 1 2 3 4\n5 2 1 10\n5 1 2\n", "line 3, character 7", "row number is 10");
  refused("9 3\n5 4 1 2 3 4\n5 2 1\n5 1 2\n", "line 3", "a row number");
  refused("9 3\n5 4 1 2 3 4\n5 1 1 3\n5 1 2\n", "line 3", "1 row numbers");
  refused("9 3\n5 4 1 2 3 4\n5 1 1\n", "line 4", "2 of 3 columns");
  refused("9 3\n5 4 1 2 3 4\n5 2 1 1\n5 1 2\n", "", "column 2 covers row 1");
}

}  // namespace
}  // namespace shelfbeam::test
