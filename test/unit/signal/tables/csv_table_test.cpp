#include "shelfbeam/signal/tables/table_reading.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

SignalTable read(std::string_view content) {
  const TempFolder folder;
  return read_signal_table(folder.write("matrix.csv", content));
}

TEST(CsvTable, ReadsIdsAndQuotes) {
  const auto table = read("label,\"T,1\",\"a \"\"b\"\"\", T3 \r\nL1, 0.5 ,0,1e-3\r\n\"two words\",+1,2,3\n");
  ASSERT_EQ(table.columns(), 3u);
  EXPECT_EQ(table.transceivers[0].id, "T,1");
  EXPECT_EQ(table.transceivers[1].id, "a \"b\"");
  EXPECT_EQ(table.transceivers[2].id, "T3");
  ASSERT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.labels[1].id, "two words");
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

TEST(CsvTable, ReadsEuropeanSpreadsheets) {
  const SignalTable expected = read("label,T1,\"north, 3\"\nL1,0.5,0.25\nL2,0,1e-3\n");
  for (const std::string_view text :
       {"label;T1;north, 3\r\nL1;0,5;0,25\r\nL2;0;1E-03\r\n",
        "label\tT1\tnorth, 3\rL1\t0,5\t0,25\rL2\t0\t0,001\r",
        "sep=;\nlabel;T1;\"north, 3\"\nL1;0.5;0.25\nL2;0;1e-3\n", "T1;north, 3\nL1;0,5;0,25\nL2;0;0,001\n",
        "label,T1,\"north, 3\"\nL1,\"0,5\",\"0,25\"\nL2,0,\"0,001\"\n"}) {
    const SignalTable table = read(text);
    ASSERT_EQ(table.columns(), 2u) << text;
    EXPECT_EQ(table.transceivers[1].id, "north, 3") << text;
    ASSERT_EQ(table.rows(), 2u) << text;
    EXPECT_EQ(table.row(0)[0].signal, expected.row(0)[0].signal) << text;
    EXPECT_EQ(table.row(0)[1].signal, expected.row(0)[1].signal) << text;
    EXPECT_EQ(table.row(1)[0].signal, expected.row(1)[0].signal) << text;
  }
  const SignalTable plain = read("0,5;0,25;3\n1;2;0\n");
  ASSERT_EQ(plain.columns(), 3u);
  EXPECT_EQ(plain.row(0)[1].signal, 0.25);
  EXPECT_EQ(read("1\t2\t3\t4\n").columns(), 4u);
  EXPECT_EQ(read("1,5\t2\n").row(0)[0].signal, 1.5);
  // A comma separates wherever only the ids have other separators.
  const SignalTable ids = read("label;x,T;1,T2\nL;1,0.5,0.25\n");
  EXPECT_EQ(ids.labels[0].id, "L;1");
  EXPECT_EQ(ids.transceivers[0].id, "T;1");
}

SignalTable read_as(std::string_view content, TableReading reading) {
  const TempFolder folder;
  return read_table(folder.write("matrix.csv", content), reading).table;
}

TEST(CsvTable, RowsOfWholeNumbersMayBeIds) {
  for (const std::string_view text :
       {"0,1,2\n0.5,0.25,0\n0,0.125,0.75\n", "0,101,102\n1,0.5,0.25\n2,0,0.125\n",
        "17;4;99\n0,5;0,25;0\n0;0,125;3\n", "1\n0.5\n0.25\n", "0,1,2,3\n1,0,0,1\n0,1,1,0\n",
        "0,11,12,13\n1,0,0,1\n2,1,1,0\n", "1\t2\t3\t4\n0\t1\t1\t0\n", "\"1\",\"2\"\n0.5,0.25\n",
        "0.0,1.0,2.0\n0.5,0.25,0\n", "4.00638E+12,4.00639E+12\n0.5,0.25\n", "0,1,2,\n0.5,0.25,0,\n"})
    expect_file_refused(read_signal_table, text, "", "may be ids or signals");
  // Negative controls: signals that only one reading fits.
  for (const std::string_view text :
       {"0,1\n1,0\n1,1\n", "0,0,1\n0.5,0.25,0\n", "1,0.5\n2,0.25\n", "3,1,2\n1,1,0\n", "0,1,2\n", "1\n2\n3\n",
        "0.5,1,2\n0.25,0,0\n", "1.0,2.0\n0.5,0.25\n"})
    EXPECT_NO_THROW(read(text)) << text;
}

TEST(CsvTable, ColumnsOfWholeNumbersMayBeIds) {
  const std::string_view text = "1,0.5,0.25\n2,0,0.125\n3,0.5,0\n";
  expect_file_refused(read_signal_table, text, "", "first column, which may be ids or signals", "'labels'");
  const SignalTable labels = read_as(text, TableReading::labels);
  EXPECT_EQ(labels.columns(), 2U);
  EXPECT_EQ(labels.labels[2].id, "3");
  EXPECT_EQ(labels.row(0)[1].signal, 0.25);
  EXPECT_EQ(read_as(text, TableReading::signals).columns(), 3U);
  for (const std::string_view other :
       {"4006381333931,0.5\n4006381333948,0.25\n", "102,5\n101,3\n", "4,00639E+12;0,5\n4,00638E+12;0\n"})
    expect_file_refused(read_signal_table, other, "", "first column, which may be ids or signals");
  for (const std::string_view other :
       {"102,5\n101,11\n", "102,5\n102,3\n", "102,5\n", "1,0.5\n2,0.25\n", "1,0.5\n3,0.25\n2,0\n",
        "1\n2\n3\n", "1,1\n2,0\n3,1\n", "0.5,1\n1.5,2\n2.5,3\n"})
    EXPECT_NO_THROW(read(other)) << other;
}

TEST(CsvTable, ColumnsOfNumbersMayBeSignals) {
  for (const std::string_view text : {"T1,T2,T3\n0.5,0.25,0\n0,0.125,0.75\n", "T1;T2\n0,5;0,25\n1;0,125\n",
                                      "T1,T2\n1,0\n0,1\n", "T1,T2\n3,0\n4,5\n"})
    expect_file_refused(read_signal_table, text, "", "first column 'T1', which may be ids or signals");
  for (const std::string_view title : {"T09,T10", "unit a,unit b", "T9,T10"})
    expect_file_refused(read_signal_table, fmt::format("{}\n3,0\n4,5\n", title), "", "may be ids or signals");
  for (const std::string_view text :
       {"T1,T\n3,0\n4,5\n", "T2,U3\n3,0\n4,5\n", "a,c\n3,0\n4,5\n", "row,T1\n0,1\n1,0\n",
        "label,T1\n0.5,0.25\n", ",T1\n1.1,1\n1.2,1\n", "id,T1\n0,1\n1,0\n", "EAN,T1\n4006381333931,1\n",
        "bay,T1\n1,1\n2,1\n", "bay,T1\n0.5,1\nA,0\n"})
    EXPECT_NO_THROW(read(text)) << text;
}

// Spreadsheets separate columns that have been in use.
TEST(CsvTable, EmptyColumnsAtTheEndAreIgnored) {
  for (const std::string_view text : {"label,T1,T2,\nA,0.5,0,\n", "T1;T2;;\nA;0,5;0;;\n"}) {
    const SignalTable table = read(text);
    ASSERT_EQ(table.columns(), 2U) << text;
    EXPECT_EQ(table.transceivers[1].id, "T2");
    EXPECT_EQ(table.labels[0].id, "A");
    EXPECT_EQ(table.row(0)[0].signal, 0.5);
  }
  EXPECT_EQ(read("0.5,0,\n1,0.25,\n").columns(), 2U);
  expect_file_refused(read_signal_table, "T1,T2\nA,0.5,\n", "line 2, field 3", "is empty");
  expect_file_refused(read_signal_table, "label,T1,T2\nA,0.5,\n", "line 2, field 3", "is empty");
  expect_file_refused(read_signal_table, "0.5,0,\n1,0.25,2\n", "line 2", "3 fields; 2 are expected");
}

// Two or three numbers between tabs also begin OR-Library files and sparse text.
TEST(CsvTable, NumbersBetweenTabsMayBeAnotherFormat) {
  EXPECT_EQ(read("0.5\t0.25\t0\n1\t0\t2\n").columns(), 3U);
  EXPECT_EQ(read("2\t3\n4\t1\n").columns(), 2U);
  EXPECT_EQ(read("2\t3\t0.5\n2\t0\t0.7\t2\t0.2\n0\n").columns(), 3U) << "sparse text";
  const std::string_view three = "2\t2\t1\n1\t0\t5\n1\t1\t7\n", two = "2\t2\n1\t1\n1\t1\n1\t2\n";
  expect_file_refused(read_signal_table, three, "", "CSV or sparse text", "'signals' or 'sparse'");
  expect_file_refused(read_signal_table, two, "", "CSV or an OR-Library file");
  EXPECT_EQ(read_as(three, TableReading::signals).rows(), 3U);
  EXPECT_EQ(read_as(three, TableReading::sparse).rows(), 2U);
  EXPECT_EQ(read_as(two, TableReading::scp).rows(), 2U);
  expect_file_refused(read_signal_table, "2\t2\t0.5\n1\t0\tx\n0\n", "line 2, character 5", "'x'");
  expect_file_refused(read_signal_table, "0.5\t0.25\n0.5\tx\n", "line 2, field 2", "'x'");
}

TEST(CsvTable, TheReadingIsChosen) {
  const std::string_view text = "0,1,2\n0.5,0.25,0\n0,0.125,0.75\n";
  const SignalTable signals = read_as(text, TableReading::signals);
  EXPECT_EQ(signals.rows(), 3U);
  EXPECT_EQ(signals.row(0)[1].signal, 2);
  const SignalTable header = read_as(text, TableReading::header);
  EXPECT_EQ(header.rows(), 2U);
  EXPECT_EQ(header.transceivers[2].id, "2");
  EXPECT_EQ(header.labels[1].id, "L2");
  EXPECT_EQ(header.row(0)[1].signal, 0.25);
  const SignalTable ids = read_as("0,101,102\n1,0.5,0.25\n2,0,0.125\n", TableReading::ids);
  EXPECT_EQ(ids.rows(), 2U);
  EXPECT_EQ(ids.labels[1].id, "2");
  EXPECT_EQ(ids.transceivers[0].id, "101");
  EXPECT_EQ(read_as("T1,T2\n0.5,0.25\n", TableReading::header).columns(), 2U);
  EXPECT_EQ(read_as("1\t2\n0.5\t0.25\n", TableReading::header).columns(), 2U) << "alone, it is refused";
  EXPECT_EQ(read_as("1,2\n7,0.5,0.25\n", TableReading::ids).labels[0].id, "7");
  const auto refused = [&](std::string_view content, TableReading reading) {
    expect_input_error([&] { read_as(content, reading); }, "matrix.csv");
  };
  refused("T1,T2\n0.5,0.25\n", TableReading::signals);
  refused(text, TableReading::scp);
  refused(text, TableReading::rail);
}

TEST(CsvTable, WarnsOfChangedIds) {
  const TempFolder folder;
  const auto warnings = [&](std::string_view content) {
    return read_table(folder.write("matrix.csv", content), TableReading::automatic).warnings;
  };
  EXPECT_TRUE(warnings("label,T1\nA,1\n").empty());
  const std::vector<Finding> found = warnings("label;4,00638E+12\n#N/A;1\nB;2\n");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, FindingCode::changed_ids);
  EXPECT_EQ(found[0].values, (FindingValues{"4,00638E+12", "#N/A"}));
  EXPECT_NE(found[0].sentence.find("'4,00638E+12' in line 1, '#N/A' in line 2;"), std::string::npos)
      << found[0].sentence;
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
      {"id,T1\n\"two\nlines\",1\n", "line 2, field 1", "unprintable character '\\n'"},
      {"id,T\xE2\x80\xAE"
       "1\nL1,1\n",
       "line 1, field 2", "has the unprintable character '\\u202e'"},
      {"id,T1,T2\nL1,0,5,0,25\n", "line 2", "5 fields; 3 are expected"},
      {"id,T1,T2\nL1,0,5,0,25\n", "", "decimal commas"},
      {"id;a,T\nL;1,5\n", "line 1", "sep=;"},
      {"id;T1;T2\nL1;0,5;0.25\n", "line 2, field 3", "'0,5'"},
      {"# from a spreadsheet, 2024\n1,2,3\n", "line 1", "comment"},
  };
  for (const auto& [text, place, problem] : all) expect_file_refused(read_signal_table, text, place, problem);
}

}  // namespace
}  // namespace shelfbeam::test
