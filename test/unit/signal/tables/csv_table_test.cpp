#include <gtest/gtest.h>

#include "shelfbeam/signal/tables/signal_table.hpp"

#include "support/expect_input_error.hpp"
#include "support/temp_folder.hpp"

namespace shelfbeam {
namespace {

using test::TempFolder;

SignalTable read(std::string_view content) {
  const TempFolder folder;
  return read_signal_table(folder.write("matrix.csv", content));
}

TEST(CsvTable, ReadsIdsAndQuotes) {
  const auto table = read("label,\"T,1\",\"a \"\"b\"\"\", T3 \r\nL1, 0.5 ,0,1e-3\r\n\"two\nlines\",+1,2,3\n");
  ASSERT_EQ(table.columns(), 3u);
  EXPECT_EQ(table.transceivers[0].id, "T,1");
  EXPECT_EQ(table.transceivers[1].id, "a \"b\"");
  EXPECT_EQ(table.transceivers[2].id, "T3");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.labels[1].id, "two\nlines");
  EXPECT_EQ(table.labels[0].requirement, 0) << "CSV has no requirement";
  ASSERT_EQ(table.row(0).size(), 2u);
  EXPECT_EQ(table.row(0)[1].transceiver, 2u);
  EXPECT_EQ(table.row(0)[1].signal, 1e-3);
  EXPECT_EQ(table.row(1)[0].signal, 1);
}

TEST(CsvTable, HeaderNeedsNoCorner) {
  const auto with = read(",T1,T2\nL1,1,2\n"), without = read("T1,T2\nL1,1,2\n");
  for (const auto& table : {with, without}) {
    ASSERT_EQ(table.columns(), 2u);
    EXPECT_EQ(table.transceivers[0].id, "T1");
    EXPECT_EQ(table.labels[0].id, "L1");
    EXPECT_EQ(table.row(0)[1].signal, 2);
  }
}

TEST(CsvTable, ReadsPlainNumbers) {
  const auto table = read(
      "\xEF\xBB\xBF"
      "0.5,0\n0.25,1\n0,0");
  ASSERT_EQ(table.rows(), 3u);
  ASSERT_EQ(table.columns(), 2u);
  EXPECT_EQ(table.labels[2].id, "L3");
  EXPECT_EQ(table.transceivers[1].id, "T2");
  EXPECT_EQ(table.row(1)[1].signal, 1);
  EXPECT_TRUE(table.row(2).empty());
  EXPECT_EQ(read("0.5\n0.25\n").rows(), 2u) << "a single column has no comma";
}

TEST(CsvTable, BrokenFilesAreRefusedWithPosition) {
  const struct {
    std::string_view text, place, problem;
  } all[] = {
      {"id,T1,T2\nL1,1,2\nL2,1,nan\n", "line 3, field 3", "NaN"},
      {"nan,1\n1,1\n", "line 1, field 1", "NaN"},
      {"1,inf\n1,1\n", "line 1, field 2", "infinite"},
      {"1,1\n1,x\n", "line 2, field 2", "'x'"},
      {"1,1\n1,1,1\n", "line 2", "3 fields"},
      {"id,T1,T2\nL1,1,2\nL2,1\n", "line 3", "2 fields"},
      {"id,T1,T1\nL1,1,2\n", "", "transceiver id 'T1'"},
      {"id,T1,\nL1,1,2\n", "line 2", "field 3"},
      {"id,T1\n,1\n", "line 2, field 1", "is empty"},
      {"id,T1\n", "line 1", "header"},
      {"id,T1\n\"L1,1\n", "line 2, field 1", "quote"},
      {"id,T1\n\"L1\"x,1\n", "line 2, field 1", "after its closing quote"},
      {"# from a spreadsheet, 2024\n1,2,3\n", "line 1", "comment"},
  };
  for (const auto& [text, place, problem] : all)
    test::expect_file_refused(read_signal_table, text, place, problem);
}

}  // namespace
}  // namespace shelfbeam
