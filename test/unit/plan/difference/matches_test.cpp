#include "shelfbeam/plan/difference/matches.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shelfbeam {
namespace {

// Pairs as "before-after" of ids, "." for none.
std::vector<std::string> paired(const std::vector<Identity>& before, const std::vector<Identity>& after,
                                SameBy first = SameBy::value) {
  std::vector<std::string> pairs;
  for (const auto& [i, j] : matches(before, after, first))
    pairs.push_back(fmt::format("{}-{}", i ? before[*i].id : ".", j ? after[*j].id : "."));
  return pairs;
}

using Pairs = std::vector<std::string>;

TEST(Matches, PairEqualThingsThenValuesThenIds) {
  EXPECT_EQ(paired({{"a", "1"}, {"b", "2"}}, {{"b", "2"}, {"a", "1"}}), (Pairs{"b-b", "a-a"}));
  EXPECT_EQ(paired({{"a", "1"}}, {{"x", "1"}}), Pairs{"a-x"}) << "renamed";
  EXPECT_EQ(paired({{"a", "1"}}, {{"a", "9"}}), Pairs{"a-a"}) << "moved";
  EXPECT_EQ(paired({{"a", "1"}}, {{"x", "9"}}), (Pairs{".-x", "a-."}));
  EXPECT_EQ(paired({}, {}), Pairs{});
}

// The thing that is still there is not taken for the one that got its id.
TEST(Matches, PreferValuesToIds) {
  EXPECT_EQ(paired({{"a", "1"}, {"b", "2"}}, {{"b", "1"}, {"a", "3"}}), (Pairs{"a-b", ".-a", "b-."}));
}

// A gondola moves by the distance of its labels: these keep their ids.
TEST(Matches, PreferIdsToValues) {
  const std::vector<Identity> before{{"a", "1"}, {"b", "2"}, {"c", "3"}},
      after{{"a", "2"}, {"b", "3"}, {"d", "4"}};
  EXPECT_EQ(paired(before, after, SameBy::id), (Pairs{"a-a", "b-b", ".-d", "c-."}));
  EXPECT_EQ(paired(before, {{"x", "1"}, {"b", "9"}}, SameBy::id), (Pairs{"a-x", "b-b", "c-."})) << "renamed";
  EXPECT_EQ(paired(before, after), (Pairs{"b-a", "c-b", ".-d", "a-."})) << "otherwise";
}

TEST(Matches, PairEqualsOnce) {
  EXPECT_EQ(paired({{"a", "1"}, {"b", "1"}}, {{"x", "1"}, {"y", "1"}, {"z", "1"}}),
            (Pairs{"a-x", "b-y", ".-z"}));
  EXPECT_EQ(paired({{"a", "1"}, {"b", "1"}}, {{"b", "1"}, {"x", "1"}}), (Pairs{"b-b", "a-x"}));
}

}  // namespace
}  // namespace shelfbeam
