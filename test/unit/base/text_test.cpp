#include "shelfbeam/base/text.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

using namespace std::string_view_literals;

TEST(Text, GroupsThousands) {
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1000), "1,000");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(counted(1, "label"), "1 label");
  EXPECT_EQ(counted(2000, "entry", "entries"), "2,000 entries");
}

TEST(Text, NearestWord) {
  constexpr std::array words = {"reflectance"sv, "roughness"sv, "ior"sv};
  EXPECT_EQ(nearest("reflectanse", words), "reflectance");
  EXPECT_EQ(nearest("roughnes", words), "roughness");
  EXPECT_EQ(nearest("oir", words), "ior");
  EXPECT_EQ(nearest("ior", words), "ior");
  EXPECT_EQ(nearest("thickness_of_pane", words), "");
  EXPECT_EQ(nearest("ior", {}), "");
  EXPECT_EQ(suggest("roughnes", words), "did you mean 'roughness'?");
  EXPECT_EQ(suggest("thickness_of_pane", words), "known: reflectance, roughness, ior");
}

TEST(Text, Join) {
  EXPECT_EQ(join(std::array{"a"sv, "b"sv, "c"sv}, ", "), "a, b, c");
  EXPECT_EQ(join({}, ", "), "");
}

TEST(Text, Trim) {
  EXPECT_EQ(trim(" \t a b\r\n"), "a b");
  EXPECT_EQ(trim(" \n"), "");
  EXPECT_EQ(trim(""), "");
}

TEST(Text, SplitKeepsEmptyFields) {
  EXPECT_EQ(split("a, b ,,c", ','), (std::vector{"a"sv, "b"sv, ""sv, "c"sv}));
  EXPECT_EQ(split("", ','), (std::vector{""sv}));
  EXPECT_EQ(split(",", ','), (std::vector{""sv, ""sv}));
}

// The definition of a match, without regard to running time.
bool matches_by_definition(std::string_view text, std::string_view pattern) {
  if (pattern.empty()) return text.empty();
  if (pattern[0] == '*')
    return matches_by_definition(text, pattern.substr(1)) ||
           (!text.empty() && matches_by_definition(text.substr(1), pattern));
  return !text.empty() && (pattern[0] == '?' || pattern[0] == text[0]) &&
         matches_by_definition(text.substr(1), pattern.substr(1));
}

TEST(Text, GlobIsAsDefined) {
  EXPECT_TRUE(matches_glob("Painted metal", "Painted*"));
  EXPECT_FALSE(matches_glob("painted metal", "Painted*"));
  EXPECT_FALSE(matches_glob("unPainted", "Painted*"));
  std::mt19937 random(1);
  int matched = 0;
  constexpr int runs = 100000;
  for (int run = 0; run < runs; ++run) {
    std::string text, pattern;
    for (auto k = random() % 7; k > 0; --k) text += "ab"[random() % 2];
    for (auto k = random() % 6; k > 0; --k) pattern += "aab??**"[random() % 7];
    const bool expected = matches_by_definition(text, pattern);
    ASSERT_EQ(matches_glob(text, pattern), expected) << text << " against " << pattern;
    matched += expected ? 1 : 0;
  }
  EXPECT_GT(matched, runs / 20) << "the samples must hold both kinds";
  EXPECT_LT(matched, runs * 19 / 20);
}

TEST(Text, GlobIsFastOnManyStars) {
  const std::string text(5000, 'a');
  std::string pattern;
  for (int k = 0; k < 50; ++k) pattern += "*a";
  EXPECT_FALSE(matches_glob(text, pattern + "b"));  // an exponential algorithm would not end
  EXPECT_TRUE(matches_glob(text, pattern));
}

TEST(Text, WholeNumbersHaveOneSpelling) {
  EXPECT_EQ(to_whole_number("0", 9), 0u);
  EXPECT_EQ(to_whole_number("17", 17), 17u);
  for (const char* text : {"", "18", "-1", "+1", "07", "00", "1.0", " 1", "1 ", "99999999999999999999999"})
    EXPECT_EQ(to_whole_number(text, 17), std::nullopt) << text;
}

TEST(Text, PrintableEscapesWhatTerminalsInterpret) {
  EXPECT_EQ(printable("Kühlregal „A“, 3 €, \xF0\x9F\x98\x80"), "Kühlregal „A“, 3 €, \xF0\x9F\x98\x80");
  EXPECT_EQ(printable("a\nb\t\x1B[31m\x7F"), "a\\nb\\x09\\x1b[31m\\x7f");
  EXPECT_EQ(printable("\xC2\x80\xC2\x9F\xC2\xA0"), "\\u0080\\u009f\xC2\xA0");
  EXPECT_EQ(printable("a\xE2\x80\xAE"
                      "b"),
            "a\\u202eb");
  EXPECT_EQ(printable("\xFF"
                      "a\xC3"),
            "\\xffa\\xc3");
  EXPECT_EQ(unprintable_character("a b é"), "");
  for (const std::string bad : {"\xD8\x9C", "\xE2\x80\x8B", "\xE2\x80\x8E", "\xE2\x80\x8F", "\xE2\x80\xA8",
                                "\xE2\x80\xA9", "\xE2\x80\xAA", "\xE2\x80\xAE", "\xE2\x81\xA6",
                                "\xE2\x81\xA9", "\xEF\xBB\xBF", "\x01", "\x7F", "\xC2\x85"})
    EXPECT_EQ(unprintable_character("a" + bad + "b"), printable(bad));
  // Negative control: the neighbours of these characters, and the joiners of Persian and Indic words.
  for (const std::string good : {"\xD8\x9B", "\xE2\x80\x8A", "\xE2\x80\x8C", "\xE2\x80\x8D", "\xE2\x80\xA7",
                                 "\xE2\x80\xAF", "\xE2\x81\xB0", "\xEF\xBB\xBE", " ", "~", "\xC2\xA0"})
    EXPECT_EQ(unprintable_character("a" + good + "b"), "") << good;
}

TEST(Text, ShortensLongValues) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefghij", 6), "abcd...ij");
  EXPECT_EQ(in_quotes("a"), "'a'");
  EXPECT_LT(in_quotes(std::string(1'000'000, 'x')).size(), 70u);
  std::string accents;
  for (int k = 0; k < 100; ++k) accents += "é";
  for (std::size_t most = 20; most < 30; ++most) EXPECT_TRUE(is_utf8(shortened(accents, most))) << most;
}

TEST(Text, NearestWordOfLongTextsTakesNoTime) {
  const std::string huge = std::string(1, 'a').append(9'999'999, 'a');
  const std::array<std::string_view, 2> words{"short", huge};
  EXPECT_EQ(nearest(huge, words), "");  // by edit distance this would take hours
  EXPECT_EQ(nearest("shrt", words), "short");
  EXPECT_LT(suggest("completely different", words).size(), 400u);
}

}  // namespace
}  // namespace shelfbeam::test
