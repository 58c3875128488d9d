#include <gtest/gtest.h>

#include "shelfbeam/report/data/text_format.hpp"

namespace shelfbeam {
namespace {

using Ids = std::vector<std::string>;

TEST(IdRanges, JoinsOnlyWhatFollowsEachOther) {
  EXPECT_EQ(id_ranges(Ids{"A1-front-1-1", "A1-front-1-2", "A1-front-1-3", "A1-front-2-4", "A1-front-2-6"}),
            (Ids{"A1-front-1-1…3", "A1-front-2-4", "A1-front-2-6"}));
  EXPECT_EQ(id_ranges(Ids{"L9", "L10", "L11"}), (Ids{"L9…11"}));
  EXPECT_EQ(id_ranges(Ids{"L08", "L09", "L10"}), (Ids{"L08…10"}));
  EXPECT_EQ(id_ranges(Ids{"7", "8"}), (Ids{"7…8"}));
  EXPECT_EQ(id_ranges(Ids{}), (Ids{}));
}

TEST(IdRanges, LeavesAloneWhatARangeWouldMisread) {
  for (const Ids& apart : {Ids{"L2", "L1"}, Ids{"L1", "L1"}, Ids{"L1", "M2"}, Ids{"L9", "L010"},
                           Ids{"L09", "L010"}, Ids{"belt", "rack"}, Ids{"a", "a1"}, Ids{"", "1"}})
    EXPECT_EQ(id_ranges(apart), apart) << apart[0];
  // More digits than fit 64 bits: the leading ones belong to the prefix.
  EXPECT_EQ(id_ranges(Ids{"123456789012345678901", "123456789012345678902"}),
            (Ids{"123456789012345678901…456789012345678902"}));
}

}  // namespace
}  // namespace shelfbeam
