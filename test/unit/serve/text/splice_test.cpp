#include "serve/text/splice.hpp"

#include <stdexcept>
#include <utility>
#include <vector>

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

TEST(Splice, SeveralApplyAtOnceAndBack) {
  const std::vector<Splice> splices{{0, "one", "1"}, {4, "", "and "}, {8, "three", "three hundred"}};
  EXPECT_EQ(spliced("one two three", splices), "1 and two three hundred");
  EXPECT_EQ(spliced("1 and two three hundred", inverse(splices)), "one two three");
  EXPECT_EQ(inverse(inverse(splices)), splices);
}

TEST(Splice, RefusesAnotherText) {
  const auto apply_to_one = [](const std::vector<Splice>& splices) { return spliced("one", splices); };
  EXPECT_THROW(apply_to_one({{0, "two", ""}}), std::invalid_argument);
  EXPECT_THROW(apply_to_one({{2, "ee", ""}}), std::invalid_argument);
  EXPECT_THROW(apply_to_one({{4, "", "x"}}), std::invalid_argument);
  EXPECT_THROW(apply_to_one({{1, "n", ""}, {0, "o", ""}}), std::invalid_argument);
}

}  // namespace
}  // namespace shelfbeam::serve
