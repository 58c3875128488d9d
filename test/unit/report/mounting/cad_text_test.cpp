#include "shelfbeam/report/mounting/cad_text.hpp"

#include <set>
#include <string>

#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

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
        texts.insert(a + b + c);
        written.insert(cad_text(a + b + c));
      }
  EXPECT_EQ(written.size(), texts.size());
}

}  // namespace
}  // namespace shelfbeam
