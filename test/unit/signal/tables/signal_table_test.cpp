#include "shelfbeam/signal/tables/signal_table.hpp"

#include "shelfbeam/signal/constraints/stack_tables.hpp"
#include "shelfbeam/signal/hdf5/signal_file.hpp"
#include "shelfbeam/signal/tables/matrix_export.hpp"

#include "support/line_ends.hpp"
#include "support/testing.hpp"
#include "unit/signal/small_matrix.hpp"

namespace shelfbeam::test {
namespace {

using Mounts = std::vector<std::vector<ColumnId>>;

// Columns 0, 3 and 4 are at one point within rounding.
SignalMatrix with_options() {
  SignalMatrix matrix = small_matrix();
  matrix.transceivers[3].position = matrix.transceivers[0].position;
  matrix.transceivers[4].position = matrix.transceivers[0].position;
  matrix.transceivers[4].position.z += 5e-7;
  return matrix;
}

TEST(SignalTable, CandidatesAtOnePositionAreOptions) {
  EXPECT_EQ(make_signal_table(small_matrix()).mounts, Mounts{});
  EXPECT_EQ(make_signal_table(small_matrix()).mounting_points(), 5U);
  SignalMatrix matrix = with_options();
  EXPECT_EQ(make_signal_table(matrix).mounts, (Mounts{{0, 3, 4}}));
  EXPECT_EQ(make_signal_table(matrix).mounting_points(), 3U);
  matrix.transceivers[4].position.z += 0.01;
  EXPECT_EQ(make_signal_table(matrix).mounts, (Mounts{{0, 3}}));

  const TempFolder folder;
  write_signal_file(with_options(), folder / "signal.h5");
  EXPECT_EQ(read_signal_table(folder / "signal.h5").mounts, (Mounts{{0, 3, 4}}));
  // A matrix without positions has no mounting points.
  write_matrix_csv(with_options(), with_options().mean, folder / "signal.csv");
  EXPECT_EQ(read_signal_table(folder / "signal.csv").mounts, Mounts{});
}

TEST(SignalTable, MarksAndLineEndsDoNotMatter) {
  const TempFolder folder;
  for (const std::string text : {",T1,T2\nA,0.5,0\nB,0,2\n", "2 2 0.5\n1 0 0.5\n1 1 2\n",
                                 "2 3\n1 1 1\n1\n1\n2\n2 3\n", "2 2\n1 1 1\n3 2 1 2\n"}) {
    const SignalTable expected = read_signal_table(folder.write("a", text));
    for (const std::string_view mark : {"", "\xEF\xBB\xBF"})
      for (const std::string_view end : {"\n", "\r\n", "\r"}) {
        const SignalTable table =
            read_signal_table(folder.write("a", std::string(mark) + with_line_ends(text, end)));
        EXPECT_EQ(table.row_begin, expected.row_begin) << text;
        for (std::size_t k = 0; k < table.entries.size(); ++k) {
          EXPECT_EQ(table.entries[k].transceiver, expected.entries[k].transceiver);
          EXPECT_EQ(table.entries[k].signal, expected.entries[k].signal);
        }
      }
  }
  expect_file_refused(read_signal_table, "2 2 0.5\r1 0 nan\r0\r", "line 2, character 5", "NaN");
}

TEST(SignalTable, RefusesTwoInstalledUnitsAtOnePoint) {
  SignalMatrix matrix = with_options();
  matrix.transceivers[3].installed = true;
  EXPECT_NO_THROW(make_signal_table(matrix));
  matrix.transceivers[4].installed = true;
  expect_input_error([&] { make_signal_table(matrix); }, "/transceivers/installed", "'G1-3-0'", "'G1-4-0'");
  const TempFolder folder;
  write_signal_file(matrix, folder / "signal.h5");
  expect_input_error([&] { read_signal_table(folder / "signal.h5"); }, "signal.h5: /transceivers/installed",
                     "'G1-3-0'", "'G1-4-0'");
}

TEST(Costs, OfTransceivers) {
  const TempFolder folder;
  SignalTable table = make_signal_table(small_matrix());
  apply_costs(table, folder.write("c.csv", "id,cost\nG1-3-0,7.5\nG1-0-0,0\n"));
  EXPECT_EQ(table.transceivers[3].cost, 7.5);
  EXPECT_EQ(table.transceivers[0].cost, 0);
  EXPECT_EQ(table.transceivers[1].cost, 2) << "not in the file: unchanged";
}

TEST(Costs, OfLabels) {
  const TempFolder folder;
  SignalTable table = make_signal_table(small_matrix());
  apply_costs(table, folder.write("c.csv", "id,signal_cost,link_cost\n\"shelf \"\"A\"\", left\",3,4\n"));
  EXPECT_EQ(table.labels[1].signal_cost, 3);
  EXPECT_EQ(table.labels[1].link_cost, 4);
  EXPECT_EQ(table.labels[2].link_cost, 0.5);
  apply_costs(table, folder.write("c.csv", "id,link_cost\nA1-front-2,9\n"));
  EXPECT_EQ(table.labels[2].link_cost, 9);
  EXPECT_EQ(table.labels[2].signal_cost, 1e-3);
}

TEST(Costs, BrokenFilesAreRefusedWithPosition) {
  SignalTable table = make_signal_table(small_matrix());
  const auto refused = [&](std::string_view content, std::string_view place, std::string_view problem) {
    expect_file_refused([&](const auto& path) { apply_costs(table, path); }, content, place, problem);
  };
  refused("", "", "empty");
  refused("id\nG1-0-0\n", "line 1", "'id,cost'");
  refused("name,cost\nG1-0-0,1\n", "line 1, field 1", "'name'");
  refused("id,price\nG1-0-0,1\n", "line 1, field 2", "'price'");
  refused("id,cost,link_cost\nG1-0-0,1,1\n", "line 1", "'id,cost'");
  refused("id,cost,cost\nG1-0-0,1,1\n", "line 1, field 3", "'cost'");
  refused("id,cost\nG1-0-0,1\nG1-0-0,1\n", "line 3, field 1", "'G1-0-0'");
  refused("id,cost\nG1-0-0,-1\n", "line 2, field 2", "negative");
  refused("id,cost\nG1-0-0\n", "line 2", "1 field");
}

TEST(Weights, OfLabels) {
  const TempFolder folder;
  SignalTable table = make_signal_table(small_matrix());
  apply_weights(table, folder.write("w.csv", "id,weight\nA1-front-2,2.5\n"));
  EXPECT_EQ(table.labels[2].weight, 2.5);
  EXPECT_EQ(table.labels[1].weight, 1) << "not in the file";
}

// A label has its weight in every scenario, unless the file names the scenario.
TEST(Weights, OfLabelsInScenarios) {
  const TempFolder folder;
  const auto scenario = [&](const char* name, const char* rows) {
    return NamedTable{name, name, read_signal_table(folder.write(name, std::string("id,T1\n") + rows))};
  };
  const auto two = [&] {
    return stack_tables({scenario("day", "L1,1\nL2,1\n"), scenario("night", "L1,1\n")});
  };
  SignalTable table = two();
  apply_weights(table, folder.write("w.csv", "id,weight\nL1,3\nday:L2,0\n"));
  EXPECT_EQ(table.labels[0].weight, 3);
  EXPECT_EQ(table.labels[1].weight, 0);
  EXPECT_EQ(table.labels[2].weight, 3);
  table = two();
  expect_file_refused([&](const auto& path) { apply_weights(table, path); }, "id,weight\nL1,3\nnight:L1,0\n",
                      "line 3, field 1", "second weight of label 'night:L1'");
}

TEST(Weights, BrokenFilesAreRefusedWithPosition) {
  SignalTable table = make_signal_table(small_matrix());
  const auto refused = [&](std::string_view content, std::string_view place, std::string_view problem) {
    expect_file_refused([&](const auto& path) { apply_weights(table, path); }, content, place, problem);
  };
  refused("", "", "empty");
  refused("id\nA1-front-2\n", "line 1", "'id,weight'");
  refused("id,cost\nA1-front-2,1\n", "line 1", "'id,weight'");
  refused("id,weight\nA1-front-9,1\n", "line 2, field 1", "'A1-front-9'");
  refused("id,weight\nA1-front-2,1\nA1-front-2,1\n", "line 3, field 1", "'A1-front-2'");
  refused("id,weight\nA1-front-2,-1\n", "line 2, field 2", "negative");
  refused("id,weight\nA1-front-2,inf\n", "line 2, field 2", "infinite");
  refused("id,weight\nA1-front-2\n", "line 2", "1 field");
}

TEST(Requirement, IsSetOnEveryLabel) {
  SignalTable table = make_signal_table(small_matrix());
  set_requirement(table, 0.25);
  for (const auto& label : table.labels) {
    EXPECT_EQ(label.requirement, 0.25);
    EXPECT_EQ(label.single_requirement, 0.25);
  }
}

}  // namespace
}  // namespace shelfbeam::test
