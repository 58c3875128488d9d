#include "serve/text/gap.hpp"

#include <string>

#include <gtest/gtest.h>

namespace shelfbeam::serve {
namespace {

std::string kinds(std::string_view gap) {
  std::string kinds;
  for (const GapPart& part : parts_of(gap)) kinds += "-n/*"[static_cast<int>(part.kind)];
  return kinds;
}

TEST(Gap, HasParts) {
  EXPECT_EQ(kinds(""), "");
  EXPECT_EQ(kinds(" \t// a \" /* \r\n/* b\n // */ \r\r\n\n/**/"), "-/n*-nnn*");
  EXPECT_EQ(kinds("/*/ a"), "*") << "not closed";
  EXPECT_EQ(gap_end(" /* a */// b\n x", 0), 14u);
  EXPECT_EQ(gap_end("/x", 0), 0u) << "not a comment";
}

TEST(Gap, FirstLineEndsOutsideOfComments) {
  EXPECT_EQ(first_line(" // a\n  "), " // a");
  EXPECT_EQ(first_line(" /* a\n b */ \r\n  "), " /* a\n b */ ");
  EXPECT_EQ(first_line("  "), "  ");
  EXPECT_FALSE(has_line_end("/*\n*/"));
  EXPECT_TRUE(has_line_end("\r"));
}

TEST(Gap, OwnLinesAreTheLastAndTheCommentsAboveIt) {
  const auto lines = [](std::string_view gap) { return std::string(gap.substr(own_lines(gap))); };
  EXPECT_EQ(lines(" // of the line\n  "), "\n  ");
  EXPECT_EQ(lines(" // of the line\n  // a\n  // b\n  "), "\n  // a\n  // b\n  ");
  EXPECT_EQ(lines("\n  // a\n\n  // b\n  "), "\n  // b\n  ");
  EXPECT_EQ(lines("\n  // a\n \n  /* b */ "), "\n  /* b */ ");
  EXPECT_EQ(lines("\r\n/* a\n b */\r\n\t"), "\r\n/* a\n b */\r\n\t");
  EXPECT_EQ(indentation("\n  // a\n\t /* b\n */ "), "\t ");
}

}  // namespace
}  // namespace shelfbeam::serve
