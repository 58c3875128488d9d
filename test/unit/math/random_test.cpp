#include "shelfbeam/math/random.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "support/hypothesis.hpp"

namespace shelfbeam {
namespace {

using Block = std::array<std::uint32_t, 4>;

// Known answers published with Random123 (kat_vectors, philox4x32, 10 rounds).
TEST(Philox, GivesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, 0), (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, 0xffffffffffffffff),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0a4093822),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Philox, UnitNumbersStayBelowOne) {
  EXPECT_EQ(to_uniform(0), 0);
  EXPECT_LT(to_uniform(0xffffffff), 1);
  EXPECT_EQ(to_index(0xffffffff, 320), 319U);
  EXPECT_EQ(to_index(0, 320), 0U);
}

// Chi-square test at level 1e-4 over 320 cells and 320,000 draws: keys and counters that differ by one must
// not correlate. In the control the lowest bit of the index is fixed.
TEST(Philox, IndicesAreUniformOverNeighbouringCounters) {
  constexpr std::uint32_t cells = 320, each = 1000, draws = each * cells;
  std::vector<double> counts(cells), stuck(cells), expected(cells, each);
  for (std::uint32_t k = 0; k < draws; ++k) {
    const std::uint32_t index = to_index(philox({k % 7, k, 3, 0}, mix_key(1, k % 5))[k % 4], cells);
    ++counts[index];
    ++stuck[index & ~1U];
  }
  EXPECT_TRUE(chi_square_test(counts, expected, 1e-4).pass);
  EXPECT_FALSE(chi_square_test(stuck, expected, 1e-4).pass);
}

}  // namespace
}  // namespace shelfbeam
