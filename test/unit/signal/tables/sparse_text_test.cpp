#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

TEST(SparseText, ReadsRowsRequirementsAndOrdersColumns) {
  const TempFolder folder;
  const auto table =
      read_signal_table(folder.write("a.txt", "3 4 0.5\r\n2 3 0.25 0 1e-3\r\n0\n\n3 0 1 1 0 2 +2\n\n"));
  ASSERT_EQ(table.rows(), 3u);
  ASSERT_EQ(table.columns(), 4u);
  EXPECT_EQ(table.labels[2].id, "L3");
  EXPECT_EQ(table.transceivers[3].id, "T4");
  for (const auto& label : table.labels) {
    EXPECT_EQ(label.requirement, 1);
    EXPECT_EQ(label.single_requirement, 0.5);
  }
  ASSERT_EQ(table.row(0).size(), 2u);
  EXPECT_EQ(table.row(0)[0].transceiver, 0u);
  EXPECT_EQ(table.row(0)[0].signal, 1e-3);
  EXPECT_EQ(table.row(0)[1].transceiver, 3u);
  EXPECT_TRUE(table.row(1).empty());
  ASSERT_EQ(table.row(2).size(), 2u) << "an entry of value 0 is no entry";
  EXPECT_EQ(table.row(2)[1].signal, 2);
}

TEST(SparseText, BrokenFilesAreRefusedWithPosition) {
  const struct {
    std::string_view text, place, problem;
  } all[] = {
      {"2 2 0.5\n1 0 nan\n0\n", "line 2, character 5", "NaN"},
      {"2 2 0.5\n1 0 inf\n0\n", "line 2", "infinite"},
      {"2 2 0.5\n0\n1 0 -0.1\n", "line 3", "negative"},
      {"2 2 0.5\n0\n1 0 1e999\n", "line 3", "'1e999'"},
      {"2 2 0.5\n0\n1 0 0.5x\n", "line 3", "'0.5x'"},
      {"2 2 0.5\n1 2 0.1\n0\n", "line 2", "column number is 2"},
      {"2 2 0.5\n1 -1 0.1\n0\n", "line 2", "column number is -1"},
      {"2 2 0.5\n1 0.5 0.1\n0\n", "line 2", "'0.5'"},
      {"2 2 0.5\n2 0 0.1\n0\n", "line 2", "a column number"},
      {"2 2 0.5\n1 0\n0\n", "line 2", "the signal"},
      {"2 2 0.5\n1 0 0.1 1 0.2\n0\n", "line 2", "1 pairs"},
      {"2 2 0.5\n3 0 0.1\n0\n", "line 2", "number of pairs is 3"},
      {"2 2 0.5\n1 0 0.1\n", "line 3", "1 of 2 labels"},
      {"2 2 0.5\n0\n0\n0\n", "line 4", "2 labels"},
      {"2 2 0\n0\n0\n", "line 1", "g is 0"},
      {"2 0 1\n0\n0\n", "line 1", "n is 0"},
      {"0.1 0.2 0.3\n0.1 0.2 0.3\n", "line 1", "m is '0.1'"},
      {"4000000000 2 0.5\n0\n", "line 1", "m is 4000000000"},
      {"1 99999999999999999999 0.5\n0\n", "line 1", "n is 99999999999999999999"},
  };
  for (const auto& [text, place, problem] : all) expect_file_refused(read_signal_table, text, place, problem);
}

TEST(AnyText, OtherContentIsRefused) {
  const TempFolder folder;
  const auto refused = [](std::string_view content, std::string_view problem) {
    expect_file_refused(read_signal_table, content, problem);
  };
  refused("", "empty");
  refused(" \n\r\n\t", "empty");
  refused("0.1|0.2\n0.3|0.4\n", "'0.1|0.2'");
  refused(std::string_view("\xFF\xFEi\0d\0", 6), "is UTF-16; save it as UTF-8");
  refused("0.1 0.2 0.3 0.4\n", "'0.1 0.2 0.3 0.4'");
  refused(std::string_view("1 2 3\n\0\1", 8), "HDF5");
  refused("\x89HDF\r\n\x1a", "HDF5");
  expect_input_error([&] { read_signal_table(folder / "missing"); }, "missing");
  expect_input_error([&] { read_signal_table(folder.path()); }, folder.path().string());
}

}  // namespace
}  // namespace shelfbeam::test
