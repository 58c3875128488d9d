#include "shelfbeam/base/changed_ids.hpp"

#include "shelfbeam/base/text.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

std::string sentence_of(const ChangedIds& changed) {
  const auto warning = changed.warning("a.csv");
  return warning ? warning->sentence : "";
}

std::string warning_about(std::initializer_list<std::string_view> ids) {
  ChangedIds changed;
  std::size_t line = 1;
  for (const std::string_view id : ids) changed.note(id, ++line);
  return sentence_of(changed);
}

TEST(ChangedIds, LostZerosShowInTheOtherSpelling) {
  EXPECT_NE(warning_about({"12345678905", "X", "012345678905"}).find("'12345678905' in line 2"),
            std::string::npos);
  EXPECT_NE(warning_about({"012345678905", "12345678905"}).find("'12345678905' in line 3"),
            std::string::npos);
  EXPECT_EQ(warning_about({"012345678905", "012345678905", "12345678912", "01", "1"}), "");
}

TEST(ChangedIds, AreRecognised) {
  for (const std::string_view id :
       split("4,00638E+12|4.00638E+12|1E+05|3.00E-12|4.006e+12|4.006381333931E12|1.2345678E7|123.0|"
             "4006381333931.00|12,0|4,006,381,333,931|4.006.381.333.931|4 006 381 333 931|"
             "4\u00A0006\u00A0381\u00A0333\u00A0931|4\u202F006\u202F381|"
             "4\u2019006\u2019381\u2019333\u2019931|4,006,381|340123450000000000|'4006381333931|undefined|"
             "=\"4006381333948\"|=A1|#N/A|#REF!|#VALUE!|#NAME?|#DIV/0!|#NV|#BEZUG!|########|Err:502|NaN|"
             "nan|NaT|<NA>|None|null|NULL|N/A|2024-02-01|2024-02-01 00:00:00|2024-02-01T00:00:00|1.2.2024|"
             "01/02/2024|01-Feb|1. Feb|3-Mär|Feb-24|Feb 2024|1-Feb-24|01. Mrz",
             '|'))
    EXPECT_NE(warning_about({id}).find(id), std::string::npos) << id;
  EXPECT_EQ(
      id_remedy("4,00638E+12", "correct it"),
      "it looks as if a spreadsheet has changed it: format the column as text before the file is saved");
  EXPECT_EQ(id_remedy("A1", "correct it"), "correct it");
}

// Ids of real shelves, articles and labels.
TEST(ChangedIds, OtherIdsAreNot) {
  for (const std::string_view id :
       split("4006381333931|A1-front-2|3E12|3E-12|12E4|E+12|1.2|1.10|10.05.2|1.2.3|12.03.24|1.234.567|#1|"
             "#12|A#!|1-2|01-02|1-2-3|2024-1|2024|DEC-01|MAR-12|Marker-1|May|Decaf 2|Jan|Feb-A|10:30|NaN1|"
             "nanny|Nation|-12|0.5|north, 3|T1|1/2|Err|+49|@home|4.006.381|1E+5|1.2E4|12.345E7|1.E12|"
             "4,006|4,06,381|4006381333931000|340123456789012300|'A'",
             '|'))
    EXPECT_EQ(warning_about({id}), "") << id;
}

TEST(ChangedIds, WholeDecimalsAreIdsBesideOtherDecimals) {
  EXPECT_EQ(warning_about({"1.0", "1.1", "2.0"}), "");
  EXPECT_EQ(
      warning_about({"1.0", "2.0"}),
      "a.csv: has ids that look as if a spreadsheet has changed them: '1.0' in line 2, '2.0' in line 3; "
      "format the column as text before the file is saved");
}

TEST(ChangedIds, LongNumbersAreIdsBesideOthersWithMoreDigits) {
  EXPECT_EQ(warning_about({"340123450000000000", "340123450000000017"}), "");
  EXPECT_NE(warning_about({"340123450000000000", "4006381333931"}), "");
}

TEST(ChangedIds, LinesAreCounted) {
  ChangedIds changed;
  for (std::size_t line = 2; line < 1002; ++line) changed.note("4,00638E+12", line);
  EXPECT_NE(sentence_of(changed).find("'4,00638E+12' in lines 2, 3, 4, 5, 6 and 995 more;"),
            std::string::npos);
  for (int k = 0; k < 7; ++k) changed.note("#REF" + std::to_string(k) + "!", 2000);
  const std::string warning = sentence_of(changed);
  EXPECT_NE(warning.find("'#REF3!' in line 2000, others in lines 2000, 2000 and 2000;"), std::string::npos)
      << warning;
  EXPECT_NE(warning_about({"#N/A", "x", "#N/A"}).find("'#N/A' in lines 2 and 4;"), std::string::npos);
}

}  // namespace
}  // namespace shelfbeam::test
