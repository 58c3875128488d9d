#include "serve/text/splice.hpp"

#include <gtest/gtest.h>

namespace shelfbeam::serve {
namespace {

TEST(Splice, IsTheShortestReplacement) {
  EXPECT_EQ(splice_between("one two three", "one 2 three"), (Splice{4, "two", "2"}));
  EXPECT_EQ(splice_between("aa", "aaa"), (Splice{2, "", "a"}));
  EXPECT_EQ(splice_between("same", "same"), (Splice{4, "", ""}));
  EXPECT_EQ(splice_between("", "new"), (Splice{0, "", "new"}));
  EXPECT_EQ(splice_between("old", ""), (Splice{0, "old", ""}));
}

TEST(Splice, TurnsOneTextIntoTheOther) {
  for (const auto& [before, after] : {std::pair{"abcabc", "abc"}, {"abab", "ababab"}, {"x", "y"}, {"", ""}})
    EXPECT_EQ(spliced(before, splice_between(before, after)), after);
}

}  // namespace
}  // namespace shelfbeam::serve
