#include "shelfbeam/base/encoding.hpp"

#include "shelfbeam/base/error.hpp"
#include "shelfbeam/base/file.hpp"
#include "shelfbeam/base/text.hpp"

#include "support/testing.hpp"

namespace shelfbeam::test {
namespace {

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

// Texts of shops, in bytes of the encoding. Escapes end where a letter could belong to them.
TEST(DecodedText, IsInTheEncodingThatMakesWords) {
  struct Sample {
    Encoding encoding;
    std::string bytes, text;
  };
  for (const auto& [encoding, bytes, text] : std::vector<Sample>{
           {Encoding::windows_1252,
            "K\xE4se;Br\xF6tchen;M\xFCsli;Cr\xE8me br\xFBl\xE9"
            "e;Jalape\xF1o",
            "Käse;Brötchen;Müsli;Crème brûlée;Jalapeño"},
           {Encoding::windows_1250, "\xAF\xF3\xB3ty ser;\x8Cmietana;\x8Cwie\xBFy chleb;Jab\xB3ka",
            "Żółty ser;Śmietana;Świeży chleb;Jabłka"},
           {Encoding::windows_1253,
            "\xC3\xDC\xEB\xE1;\xD8\xF9\xEC\xDF;\xD4\xF5\xF1\xDF \xF6\xDD\xF4\xE1;"
            "\xC5\xEB\xE1\xE9\xFC\xEB\xE1\xE4\xEF",
            "Γάλα;Ψωμί;Τυρί φέτα;Ελαιόλαδο"},
           {Encoding::macintosh,
            "K\x8Ase;Br\x9Atchen;M\x9Fsli;Cr\x8Fme br\x9El\x8E"
            "e",
            "Käse;Brötchen;Müsli;Crème brûlée"}}) {
    const DecodedText guessed = decoded_text(bytes);
    EXPECT_EQ(guessed.text, text);
    EXPECT_EQ(guessed.encoding, encoding) << text;
    EXPECT_TRUE(guessed.is_whole);
  }
  const DecodedText chosen = decoded_text("a;K\xE4se", Encoding::windows_1251);
  EXPECT_EQ(chosen.text, "a;Kдse");
  EXPECT_EQ(chosen.example, "Kдse");
}

TEST(DecodedText, OfTablesThatPeopleReported) {
  for (const auto& [file, encoding, word] : std::vector<std::tuple<const char*, Encoding, const char*>>{
           {"names_shift_jis.csv", Encoding::shift_jis, ";処理牛乳;"},
           {"names_1251.csv", Encoding::windows_1251, ";Молоко;"},
           {"names_850.csv", Encoding::cp850, ";Käse;"}}) {
    const std::string bytes = read_file(std::string(SHELFBEAM_SOURCE_DIR "/test/data/field4/") + file);
    const DecodedText table = decoded_text(bytes);
    EXPECT_EQ(table.encoding, encoding) << file;
    EXPECT_NE(table.text.find(word), std::string::npos) << table.text;
  }
}

TEST(DecodedText, NeedsNoGuessInUnicode) {
  const std::u32string_view letters = U"n;M\xFCsli\n";
  for (const std::string& bytes :
       {std::string("n;Müsli\n"), std::string("\xEF\xBB\xBFn;Müsli\n\x1A"),
        wide(U"\xFEFF", 2, ByteOrder::little) + wide(letters, 2, ByteOrder::little),
        wide(U"\xFEFF", 2, ByteOrder::big) + wide(letters, 2, ByteOrder::big)}) {
    const DecodedText decoded = decoded_text(bytes, Encoding::gbk);
    EXPECT_EQ(decoded.text, "n;Müsli\n");
    EXPECT_EQ(decoded.encoding, std::nullopt);
    EXPECT_TRUE(decoded.is_whole);
  }
}

TEST(DecodedText, ShowsBytesWithoutACharacter) {
  const DecodedText decoded = decoded_text(
      "a\x81\x81"
      "b",
      Encoding::windows_1252);
  EXPECT_FALSE(decoded.is_whole);
  EXPECT_EQ(decoded.text, "a\uFFFD\uFFFDb");
  EXPECT_FALSE(decoded_text("\xFF\xFE"
                            "a")
                   .is_whole)
      << "half a unit of UTF-16";
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
}  // namespace shelfbeam::test
