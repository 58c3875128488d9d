#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/text.hpp"

#include "support/expect_input_error.hpp"

namespace shelfbeam {
namespace {

using test::expect_input_error;

enum class ByteOrder { little, big };

// A text of code points in units of 2 or 4 bytes.
std::string wide(std::u32string_view text, std::size_t bytes, ByteOrder order) {
  std::string result;
  for (const char32_t code : text)
    for (std::size_t k = 0; k < bytes; ++k)
      result += static_cast<char>(code >> 8 * (order == ByteOrder::little ? k : bytes - 1 - k) & 0xFFU);
  return result;
}

TEST(Encoding, WideTextsAreNamed) {
  const std::vector<std::u32string_view> texts{U"{\"a\": 1}", U"id,x,y\r\n",
                                               U"\x41F\x43B\x430\x43D: 12.5; 7 m", U"ü"};
  for (const ByteOrder order : {ByteOrder::little, ByteOrder::big})
    for (const std::size_t bytes : {2U, 4U})
      for (const std::u32string_view text : texts)
        for (const std::u32string_view mark : {U"\xFEFF", U""}) {
          const std::string file = wide(mark, bytes, order) + wide(text, bytes, order);
          expect_input_error([&] { without_mark(file, "a.txt"); }, "a.txt: is ",
                             bytes == 2 ? "UTF-16" : "UTF-32", "save it as UTF-8");
        }
}

TEST(Encoding, OtherTextsAreNotTakenForWide) {
  using namespace std::string_view_literals;
  for (const std::string_view text :
       {""sv, "a"sv, "ab"sv, "id,x"sv, "a\0bc"sv, "\0\0"sv, "\0\0\0\0\0\0\0\0"sv, "K\xFChlregal"sv,
        "solid\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0"sv})
    EXPECT_EQ(without_mark(text, "a.txt"), text);
}

TEST(Encoding, MarksAreRemoved) {
  EXPECT_EQ(without_mark("\xEF\xBB\xBF{}", ""), "{}");
  EXPECT_EQ(without_mark("\xEF\xBB\xBF\xEF\xBB\xBF{}", ""), "{}") << "some programs add a second one";
  EXPECT_EQ(without_mark("\xEF\xBB\xBF", ""), "");
  EXPECT_EQ(without_mark("\xEF\xBB{}", ""), "\xEF\xBB{}");
}

TEST(Encoding, LinesEndInThreeWays) {
  for (const std::string_view text : {"a\nb\n\nc", "a\r\nb\r\n\r\nc\r\n", "a\rb\r\rc\r", "a\rb\r\n\nc\n"}) {
    std::vector<std::string_view> lines;
    for (std::string_view rest = text; !rest.empty();) lines.push_back(take_line(rest));
    EXPECT_EQ(lines, (std::vector<std::string_view>{"a", "b", "", "c"})) << text;
  }
}

TEST(Encoding, ErrorsEscapeBytesOfFiles) {
  const InputError error(std::string("a\0.json", 7), "has the name 'wh\x1Bite\xFF' \n",
                         std::string("remove \0", 8));
  EXPECT_STREQ(error.what(), "a\\x00.json: has the name 'wh\\x1bite\\xff' \\n; remove \\x00");
  EXPECT_STREQ(OutputError(OutputError("b", "c"), std::string("\0d", 2), Setting::none).what(),
               "b: c; \\x00d");
  EXPECT_STREQ(InputError("Kühlregal", "„é“").what(), "Kühlregal: „é“");
}

}  // namespace
}  // namespace shelfbeam
