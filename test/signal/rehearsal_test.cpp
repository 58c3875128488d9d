#include "shelfbeam/signal/detail/rehearsal.hpp"

#include <csignal>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace shelfbeam::detail {
namespace {

using std::chrono::seconds;

constexpr std::size_t memory = 1 << 28;

bool ends(const std::function<void()>& action) {
  return ends_well(action, seconds(1), memory);
}

TEST(Rehearsal, TellsWhatEnds) {
  int changed = 0;
  EXPECT_TRUE(ends([&] { changed = 1; }));
  EXPECT_EQ(changed, 0) << "that was a copy";
  EXPECT_TRUE(ends([] { throw std::runtime_error("refused"); }));
}

TEST(Rehearsal, TellsWhatDoesNot) {
  EXPECT_FALSE(ends([] { std::raise(SIGSEGV); }));
  EXPECT_FALSE(ends([] { std::abort(); }));
  EXPECT_FALSE(ends([] {
    const volatile bool goes_on = true;
    while (goes_on) {
    }
  }));
}

TEST(Rehearsal, BoundsTheMemory) {
  const auto take = [](std::size_t bytes) {
    return [bytes] {
      try {
        std::vector<char> taken(bytes);
        if (taken.size() == bytes) std::abort();
      } catch (const std::bad_alloc&) {
      }
    };
  };
  EXPECT_TRUE(ends(take(4 * memory))) << "refused, so it did not come to its end";
  EXPECT_FALSE(ends(take(memory / 4))) << "taken";
}

}  // namespace
}  // namespace shelfbeam::detail
