#include "shelfbeam/report/data/text_format.hpp"

#include "shelfbeam/report/mounting/cad_text.hpp"
#include "shelfbeam/report/text/numbers.hpp"
#include "shelfbeam/report/text/words.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

TEST(TextFormat, EscapesMarkup) {
  EXPECT_EQ(escape("A<1> & \"B\" 'c'"), "A&lt;1&gt; &amp; &quot;B&quot; &#39;c&#39;");
  EXPECT_EQ(escape(std::string("a\x01"
                               "b",
                               3)),
            "a\uFFFD"
            "b");
  EXPECT_EQ(escape("Käse, 奶酪"), "Käse, 奶酪");
  EXPECT_EQ(escape("<\xFF"), "&lt;\\xff");
}

TEST(TextFormat, KeepsSignificantDigits) {
  EXPECT_EQ(english().significant(0), "0");
  EXPECT_EQ(english().significant(0.0185), "0.0185");
  EXPECT_EQ(english().significant(9.996), "10.0");
  EXPECT_EQ(english().significant(123.4), "123");
  EXPECT_EQ(english().significant(-2.5), "−2.50");
  EXPECT_EQ(english().significant(1.234e-7), "1.23·10^-7");
  EXPECT_EQ(english().significant(infinite), "∞");
}

TEST(TextFormat, WritesDecibelsUnambiguously) {
  EXPECT_EQ(english().decibels(3.16), "+3.2\u00A0dB");
  EXPECT_EQ(english().decibels(-0.42), "−0.4\u00A0dB");
  EXPECT_EQ(english().decibels(0.012), "+0.01\u00A0dB");
  EXPECT_EQ(english().decibels(3.164, 2), "+3.16\u00A0dB");
  EXPECT_EQ(english().decibels(-0.0001), "0.00\u00A0dB");
  EXPECT_EQ(english().decibels(-infinite), "no signal");
  EXPECT_EQ(english().decibels(infinite), "no requirement");
}

TEST(TextFormat, PicksAReadablePrefix) {
  EXPECT_EQ(signal_unit(english(), 0.0185).text(0.0185), "18.5\u00A0mW/m²");
  EXPECT_EQ(signal_unit(english(), 2).text(0.0185), "0.0185\u00A0W/m²");
  EXPECT_EQ(signal_unit(english(), 3e-6).text(3e-6), "3.00\u00A0µW/m²");
  EXPECT_EQ(signal_unit(english(), 0).text(1.5), "1.50\u00A0W/m²");
}

TEST(TextFormat, WritesRoundNumbersWithoutZeros) {
  EXPECT_EQ(english().plain(250), "250");
  EXPECT_EQ(english().plain(-2.5), "−2.5");
  EXPECT_EQ(english().plain(-0.0), "0");
  EXPECT_EQ(english().percent(1.0 / 6), "16.7\u00A0%");
}

using Ids = std::vector<std::string>;

TEST(TextFormat, RoundsBoundsToTheSafeSide) {
  EXPECT_EQ(rounded_down(94.97, 1), 94.9);
  EXPECT_EQ(rounded_up(94.91, 1), 95);
  EXPECT_EQ(rounded_down(1020, 2), 1020);
  EXPECT_EQ(rounded_down(0.1 + 0.2, 1), 0.3) << "errors of floating point";
  EXPECT_EQ(rounded_up(0.1 + 0.2, 1), 0.3);
  EXPECT_EQ(rounded_down(-0.25, 1), -0.3);
  EXPECT_EQ(english().plain_down(1234567.8), "1.23456e+06");
  EXPECT_EQ(english().plain(1234567.8), "1.23457e+06") << "the control";
  EXPECT_EQ(english().plain_down(123.45678), "123.456");
  EXPECT_EQ(english().plain_down(1070), "1070");
  EXPECT_EQ(english().plain_down(0), "0");
  EXPECT_EQ(english().plain_down(infinite), english().plain(infinite));
  EXPECT_EQ(english().confidence_text(0.99), "99");
  EXPECT_EQ(english().confidence_text(0.999), "99.9");
  EXPECT_EQ(english().confidence_text(0.999999), "99.9999");
  EXPECT_EQ(english().confidence_text(0.99999995), "99.9999");
}

TEST(IdRanges, JoinsOnlyConsecutiveIds) {
  EXPECT_EQ(id_ranges(Ids{"A1-front-1-1", "A1-front-1-2", "A1-front-1-3", "A1-front-2-4", "A1-front-2-6"}),
            (Ids{"A1-front-1-1…3", "A1-front-2-4", "A1-front-2-6"}));
  EXPECT_EQ(id_ranges(Ids{"L9", "L10", "L11"}), (Ids{"L9…11"}));
  EXPECT_EQ(id_ranges(Ids{"L08", "L09", "L10"}), (Ids{"L08…10"}));
  EXPECT_EQ(id_ranges(Ids{"7", "8"}), (Ids{"7…8"}));
  EXPECT_EQ(id_ranges(Ids{}), (Ids{}));
}

TEST(IdRanges, KeepsAmbiguousIdsApart) {
  for (const Ids& ids : {Ids{"L2", "L1"}, Ids{"L1", "L1"}, Ids{"L1", "M2"}, Ids{"L9", "L010"},
                         Ids{"L09", "L010"}, Ids{"belt", "rack"}, Ids{"a", "a1"}, Ids{"", "1"}})
    EXPECT_EQ(id_ranges(ids), ids) << ids[0];
  // With more digits than fit 64 bits, the leading ones belong to the prefix.
  EXPECT_EQ(id_ranges(Ids{"123456789012345678901", "123456789012345678902"}),
            (Ids{"123456789012345678901…456789012345678902"}));
}

TEST(CadText, EscapesLettersBeyondAscii) {
  EXPECT_EQ(cad_text("A1-front, 2 (left)"), "A1-front, 2 (left)");
  EXPECT_EQ(cad_text("Kühlregal €"), "K\\U+00FChlregal \\U+20AC");
  EXPECT_EQ(cad_text("\xF0\x9F\x98\x80"), "\\U+D83D\\U+DE00");
  EXPECT_EQ(cad_text("a\nb\x7F"), "a\\U+000Ab\\U+007F");
  EXPECT_EQ(cad_text(""), "");
}

TEST(CadText, HasNoCodesOfCadPrograms) {
  EXPECT_EQ(cad_text("50%"), "50%");
  EXPECT_EQ(cad_text("45%%d"), "45%\\U+200B%d");
  EXPECT_EQ(cad_text("%%%"), "%\\U+200B%\\U+200B%");
  EXPECT_EQ(cad_text("a^J"), "a^ J");
  EXPECT_EQ(cad_text("\\U+00FC"), "\\U+005CU+00FC");
  EXPECT_EQ(cad_text(" a "), "\\U+0020a\\U+0020");
}

TEST(CadText, KeepsTextsDifferent) {
  std::set<std::string> texts, written;
  const std::string parts[] = {"%", "%%", "^", "^ ", "J", "\\", "\\U+00FC", "ü", "ö", " ", "?", "a"};
  for (const std::string& a : parts)
    for (const std::string& b : parts)
      for (const std::string& c : parts) {
        const std::string text = fmt::format("{}{}{}", a, b, c);
        texts.insert(text);
        written.insert(cad_text(text));
      }
  EXPECT_EQ(written.size(), texts.size());
}

}  // namespace
}  // namespace shelfbeam::test
