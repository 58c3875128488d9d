#include "shelfbeam/base/csv.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using namespace std::string_literals;

using Rows = std::vector<std::vector<std::string>>;

Rows rows_of(const std::string& text) {
  CsvReader csv(text, "f.csv");
  Rows rows;
  while (csv.next()) rows.emplace_back(csv.fields().begin(), csv.fields().end());
  return rows;
}

// The numbers of all records after the first.
std::vector<double> numbers_of(const std::string& text) {
  CsvReader csv(text, "f.csv");
  std::vector<double> numbers;
  csv.next();
  while (csv.next())
    for (std::size_t k = 0; k < csv.fields().size(); ++k) numbers.push_back(csv.number(k));
  return numbers;
}

void expect_refused(const std::string& text, const std::vector<std::string>& parts) {
  const std::string message = input_error([&] { numbers_of(text); });
  EXPECT_TRUE(message.starts_with("f.csv")) << text << ": " << message;
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << text << ": '" << part << "' is not in: " << message;
}

// The text with other separators and line ends than "," and "\n".
std::string with(std::string_view text, std::string_view separator, std::string_view end) {
  std::string result;
  for (const char& c : text) result += c == ',' ? separator : c == '\n' ? end : std::string_view(&c, 1);
  return result;
}

TEST(Csv, SeparatorsBomAndLineEndsMakeNoDifference) {
  const Rows expected{{"id", "x", "note"}, {"a", "1.5", ""}, {"b c", "2", "\"q\""}};
  const std::string bom = "\xEF\xBB\xBF", lines = "id,x,note\na , 1.5,\n\n,,,\n\"b c\",2,\"\"\"q\"\"\"\n";
  for (const char* separator : {",", ";", "\t"})
    for (const char* end : {"\n", "\r\n", "\r"})
      for (const std::string& begin : {""s, bom, "sep=,\n"s, bom + "\"sep=,\"\n"}) {
        const std::string text = with(begin, separator, end) + with(lines, separator, end);
        EXPECT_EQ(rows_of(text), expected) << testing::PrintToString(text);
      }
  EXPECT_EQ(rows_of("id,x\na;b,\"c;d\"\n"), (Rows{{"id", "x"}, {"a;b", "c;d"}})) << "the header decides";
  EXPECT_EQ(rows_of("id;x\n\"a,b\";c,d\n"), (Rows{{"id", "x"}, {"a,b", "c,d"}}));
  EXPECT_EQ(rows_of("id \t,\tx\na,b\n"), (Rows{{"id", "x"}, {"a", "b"}})) << "tabs as blanks";
  EXPECT_EQ(rows_of("a b\n1 2\n"), (Rows{{"a b"}, {"1 2"}})) << "a single column";
}

TEST(Csv, LinesAreCountedWithAllLineEnds) {
  for (const char* end : {"\n", "\r\n", "\r"}) {
    expect_refused(with("a;b\n1;2\n1;x\n", ",", end), {"line 3, field 2", "'x'"});
    const std::string quoted = with("sep=;\na;b\n\n1;\"2\n\"\nx;\"2", ",", end);
    EXPECT_EQ(input_error([&] { rows_of(quoted); }),
              "f.csv: line 6, field 2: has an unclosed quote; close it with '\"'");
  }
}

TEST(Csv, ReadsDecimalCommas) {
  const std::vector<double> expected{1.5, -0.25, 1e-3, 1200};
  EXPECT_EQ(numbers_of("a;b;c;d\n1,5;-0,25;1,0e-3;1200\n"), expected);
  EXPECT_EQ(numbers_of("a\tb\tc\td\n1,5\t-,25\t1E-03\t+1200\n"), expected);
  EXPECT_EQ(numbers_of("a;b;c;d\n1.5;-0.25;1e-3;1200\n"), expected);
  EXPECT_EQ(numbers_of("a,b,c,d\n\"1,5\",\"-0,25\",1e-3,1200\n"), expected);
  EXPECT_EQ(numbers_of("a;b\n1,500;2,125\n"), (std::vector<double>{1.5, 2.125}))
      << "the decimal comma of spreadsheets that separate by semicolons";
  EXPECT_EQ(numbers_of("a,b\n1.500,2.125\n"), (std::vector<double>{1.5, 2.125}));
  EXPECT_EQ(numbers_of("a;b\n1.500;0.125\n"), (std::vector<double>{1.5, 0.125})) << "0.125 decides";
  EXPECT_EQ(numbers_of("a;b\n1.500;2.12\n"), (std::vector<double>{1.5, 2.12}));
}

TEST(Csv, RefusesAmbiguousNumbers) {
  expect_refused("a;b\n1;1.234,56,7\n", {"line 2, field 2", "'1.234,56,7'", "thousands"});
  expect_refused("a;b\n1;1.23.567\n", {"'1.23.567'", "thousands"});
  expect_refused("a;b\n1;12 34,5\n", {"'12 34,5'", "thousands"});
  expect_refused("a;b\n1.250;2\n0,5;1\n", {"line 3, field 1", "'0,5'", "line 2", "'1.250'"});
  expect_refused("a;b\n1;25 cm\n", {"'25 cm'", "without a unit"});
  expect_refused("a;b\n1;1/2\n", {"'1/2'", "a number is expected"});
  expect_refused("a;b\n1;2,5\n3;2.5\n", {"line 3, field 2", "'2.5'", "line 2", "'2,5'"});
  expect_refused("a;b\n1;2.5\n3;2,5\n", {"line 3, field 2", "'2,5'", "line 2", "'2.5'"});
  expect_refused("a,b\n1,2.5\n3,\"2,5\"\n", {"line 3, field 2", "line 2"});
  expect_refused("a,b\n1,\"2,5\"\n3,2.5\n", {"line 3, field 2", "line 2"});
  expect_refused("a;b\n1;2\n3;1.500\n4;-2.125\n", {"line 3, field 2", "'1.500'", "'1500' or '1.5000'"});
  expect_refused("a\tb\n1\t\"1,500\"\n", {"line 2, field 2", "'1,500'"});
  expect_refused("a,b\n1,\"1,500\"\n", {"line 2, field 2", "'1,500'"});
  expect_refused("a;b\n1;2,5x\n", {"'2,5x'", "a number is expected"});
  expect_refused("a;b\n1;,\n", {"','"});
  EXPECT_EQ(input_error([] { numbers_of("a;b\n1;2,5x\n"); }).find("thousands"), std::string::npos);
}

TEST(Csv, ReadsThousandsThatShowTheirMark) {
  EXPECT_EQ(numbers_of("a;b;c;d\n1.234,5;1.234.567;1 234,5;-1'250\n"),
            (std::vector<double>{1234.5, 1234567, 1234.5, -1250}));
  EXPECT_EQ(numbers_of("a;b\n1,234.5;1,234,567\n"), (std::vector<double>{1234.5, 1234567}));
}

// The number of a case of written_numbers.tsv, of lengths in m, in a table between tabs.
std::optional<double> read_case(std::string_view text, std::string_view unit, std::string_view shown) {
  std::string table = "a\tb\n";
  if (shown != "-") table += std::string(shown) + "\t0\n";
  table += std::string(text) + "\t0\n";
  try {
    CsvReader csv(table, "f.csv");
    std::optional<double> number;
    csv.next();
    while (csv.next()) {
      if (unit == "-") {
        number = csv.number(0);
      } else {
        const auto length = csv.length(0, from_text<LengthUnit>(unit).value());
        number = to_metres(length.value, length.unit);
      }
    }
    return number;
  } catch (const InputError&) {
    return {};
  }
}

TEST(Csv, ReadsNumbersAsPeopleWriteThem) {
  const std::string file = read_file(SHELFBEAM_SOURCE_DIR "/test/data/written_numbers.tsv");
  std::size_t count = 0, refused = 0;
  for (const std::string_view line : split(file, '\n')) {
    if (line.empty()) continue;
    const std::vector<std::string_view> fields = split(line, '\t');
    const double right = to_number(fields[3]).value();
    const auto read = read_case(fields[0], fields[1], fields[2]);
    EXPECT_EQ(read.has_value(), fields[4] == "read") << line;
    if (read) {
      EXPECT_NEAR(*read, right, 1e-12 * std::abs(right)) << line;
    }
    ++count;
    refused += read ? 0 : 1;
  }
  EXPECT_GE(count, 2000u);
  EXPECT_LT(refused, count / 5);
}

TEST(Csv, WholeLengthsShowThatTheSeparatorDoesNotTellTheMark) {
  const auto lengths = [](const std::string& text) {
    CsvReader csv(text, "f.csv");
    std::vector<double> read;
    csv.next();
    while (csv.next()) read.push_back(csv.length(0, LengthUnit::mm).value);
    return read;
  };
  EXPECT_EQ(lengths("a;b\n0,250;0\n1,250;0\n2;0\n"), (std::vector<double>{0.25, 1.25, 2}));
  EXPECT_EQ(lengths("a;b\n1,250;0\n2,125;0\n0;0\n"), (std::vector<double>{1.25, 2.125, 0}));
  for (const char* text : {"a;b\n250;0\n1,250;0\n", "a,b\n1.250,0\n250,0\n", "a,b\n1.250 mm,0\n250 mm,0\n"})
    expect_input_error([&] { lengths(text); }, std::string_view("thousands separator"),
                       std::string_view("write '1250' or '1"));
}

TEST(Csv, CountsFields) {
  const auto read = [](const std::string& text) {
    CsvReader csv(text, "f.csv");
    csv.next();
    csv.expect_fields(2, 3, ", at least");
    return csv.fields().size();
  };
  EXPECT_EQ(read("1,2"), 2u);
  EXPECT_EQ(read("1,2,3,,"), 5u) << "empty fields at the end";
  EXPECT_EQ(input_error([&] { read("1"); }), "f.csv: line 1: has 1 field; 2 are expected, at least");
  const std::string many = input_error([&] { read("1,5,2,5"); });
  EXPECT_NE(many.find("has 4 fields; 3 are expected, at least; numbers with decimal commas"),
            std::string::npos);
  EXPECT_EQ(input_error([&] { read("1;5;2;5"); }).find("decimal"), std::string::npos);
}

TEST(Csv, FillsMergedCellsDown) {
  CsvReader csv("fixture,level,x\nA,1,3\n,,4\n,2,\nB,,5\n,3,6\n", "f.csv");
  csv.next();
  csv.fill_down({0, 1});
  Rows rows;
  while (csv.next()) rows.emplace_back(csv.fields().begin(), csv.fields().end());
  EXPECT_EQ(rows, (Rows{{"A", "1", "3"}, {"A", "1", "4"}, {"A", "2", ""}, {"B", "", "5"}, {"B", "3", "6"}}))
      << "a level of A is not one of B";
}

TEST(Csv, RefusesOtherEncodingsAndSeparators) {
  const auto refused = [](const std::string& text, const std::string& part) {
    const std::string message = input_error([&] { rows_of(text); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  refused("\xFF\xFEi\0d\0"s, "is UTF-16; save it as UTF-8");
  refused("\xFE\xFF\0i\0d"s, "is UTF-16");
  refused("i\0d\0"s, "is UTF-16");
  refused("id\nK\xFChltruhe\n", "is not UTF-8");
  refused("sep=|\nid|x\n", "line 1: names the unknown separator '|'");
  EXPECT_EQ(rows_of("sep=;;\n"), (Rows{{"sep=", "", ""}})) << "not a statement";
}

TEST(Csv, IdsArePrintable) {
  const auto id = [](const std::string& text) {
    CsvReader csv(text, "f.csv");
    csv.next();
    return csv.id(0);
  };
  EXPECT_EQ(id("Kühlregal 3,x"), "Kühlregal 3");
  const std::vector<std::string> bad{"a\x1B[31m", "a\nb", "a\u202Eb", "\xE2\x80\x8B", "a\xC2\x85"};
  for (const std::string& text : bad)
    EXPECT_NE(input_error([&] { id("\"" + text + "\""); }).find("field 1: has the unprintable character"),
              std::string::npos)
        << text;
}

// Plain and safe files restore every text.
TEST(Csv, FormulasSurviveTheRoundTrip) {
  const std::vector<std::string> texts{"=1+1", "+x",    "-1",        "@SUM(A1)", "'=1", "''=1", "'",
                                       "''",   "'t",    "'t, hooft", "=a,\"b\"", "a=b", "-\"'", "\"",
                                       "a",    "'-a,b", "=\"x\"",    "é",        "a;b", "'@",   "' =1"};
  for (const bool safe : {false, true})
    for (const std::string& text : texts) {
      const std::string line = "id," + csv_field(text, safe) + ",end\n";
      CsvReader csv(line, "f.csv");
      ASSERT_TRUE(csv.next()) << text;
      EXPECT_EQ(csv.text(1), text) << line;
      // As a spreadsheet unquotes it.
      const std::string_view cell = csv.fields()[1];
      EXPECT_TRUE(!safe || cell.find_first_of("=+-@") != 0) << line;
    }
  EXPECT_EQ(csv_field("=1+1"), "=1+1");
  EXPECT_EQ(csv_field("=1+1", true), "'=1+1");
  EXPECT_EQ(csv_field("=a,b", true), "\"'=a,b\"");
  EXPECT_EQ(csv_field("A-1", true), "A-1");
  EXPECT_EQ(csv_field("'t", true), "'t");
}

}  // namespace
}  // namespace shelfbeam::test
