#include "shelfbeam/placement/answer/incumbent.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace shelfbeam::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(Incumbent, KeepsTheBetterSelectionAndTheHigherBound) {
  Incumbent incumbent(ValueSteps(1), 2);
  EXPECT_FALSE(incumbent.has_selection());
  EXPECT_FALSE(incumbent.is_closed());
  EXPECT_TRUE(incumbent.offer({1, 2, 3, 4}, 4));
  EXPECT_FALSE(incumbent.offer({5, 6, 7, 8}, 4)) << "no better";
  EXPECT_EQ(incumbent.selected(), (Selection{1, 2, 3, 4}));
  EXPECT_FALSE(incumbent.raise(1.5, BoundProof::dual, "a step")) << "lower";
  EXPECT_EQ(incumbent.proof(), BoundProof::trivial);
  EXPECT_TRUE(incumbent.raise(2.2, BoundProof::dual, "a step"));
  EXPECT_EQ(incumbent.bound(), 3) << "rounded up to a step";
  EXPECT_FALSE(incumbent.is_closed());
  EXPECT_TRUE(incumbent.raise(3.1, BoundProof::branches, "a step"));
  EXPECT_TRUE(incumbent.is_closed());
  EXPECT_EQ(incumbent.proof(), BoundProof::branches);
  EXPECT_FALSE(incumbent.offer({1, 2}, 5));
  EXPECT_EQ(incumbent.value(), 4);
}

TEST(Incumbent, BelievesASelectionRatherThanABound) {
  Incumbent incumbent(ValueSteps(1), 0);
  incumbent.replace({1, 2, 3}, 3);
  for (const double bound : {3.5, infinity}) {
    EXPECT_TRUE(incumbent.contradicts(bound));
    EXPECT_FALSE(incumbent.raise(bound, BoundProof::solver, "MIP"));
    EXPECT_FALSE(incumbent.is_closed());
    EXPECT_THROW(incumbent.raise(bound, BoundProof::dual, "multipliers"), std::logic_error);
  }
  EXPECT_EQ(incumbent.bound(), 0);
}

TEST(Incumbent, IsClosedByASolverWithinItsTolerance) {
  Incumbent sum(ValueSteps(0), 0);
  sum.replace({1}, 10);
  sum.raise(10 - 2e-5, BoundProof::solver, "MIP");
  EXPECT_FALSE(sum.is_closed());
  sum.raise(10 - 5e-6, BoundProof::dual, "multipliers");
  EXPECT_FALSE(sum.is_closed()) << "our bounds are exact";
  sum.raise(10 - 4e-6, BoundProof::solver, "MIP");
  EXPECT_TRUE(sum.is_closed());
  // A small part of sums that round by 1e-3.
  Incumbent part(ValueSteps(0, 1e-3), 0);
  part.replace({1}, 10);
  EXPECT_FALSE(part.contradicts(11));
  EXPECT_TRUE(part.contradicts(13));
  part.raise(9, BoundProof::solver, "MIP");
  EXPECT_TRUE(part.is_closed());
}

TEST(Incumbent, IsClosedIfNoSelectionExists) {
  Incumbent incumbent(ValueSteps(1), 0);
  incumbent.raise(infinity, BoundProof::search, "enumeration");
  EXPECT_TRUE(incumbent.is_closed());
  EXPECT_FALSE(incumbent.has_selection());
}

}  // namespace
}  // namespace shelfbeam::detail
