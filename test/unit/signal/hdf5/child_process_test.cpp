#include "shelfbeam/signal/hdf5/child_process.hpp"

#include <csignal>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "support/sanitizers.hpp"

namespace shelfbeam::detail {
namespace {

using std::chrono::seconds;

constexpr std::size_t memory = 1 << 28;

// Whether a child that gives nothing ends well.
bool ends(const std::function<void()>& action) {
  return through_child([&](PipeWriter&) { action(); }, [](PipeReader&) {}, seconds(1), memory);
}

TEST(ChildProcess, HandsOverWhatItMade) {
  int number = 0;
  std::string text;
  std::vector<float> array;
  const auto give = [&](PipeWriter& pipe) {
    std::vector<float> made(1'000'000, 0.5f);
    made.back() = 7;
    pipe(42), pipe(std::string("answer")), pipe(made);
  };
  const auto take = [&](PipeReader& pipe) { pipe(number), pipe(text), pipe(array); };
  ASSERT_TRUE(through_child(give, take, seconds(10), memory));
  EXPECT_EQ(number, 42);
  EXPECT_EQ(text, "answer");
  ASSERT_EQ(array.size(), 1'000'000u);
  EXPECT_EQ(array.front(), 0.5f);
  EXPECT_EQ(array.back(), 7.0f);
}

TEST(ChildProcess, IsACopy) {
  int changed = 0;
  EXPECT_TRUE(ends([&] { changed = 1; }));
  EXPECT_EQ(changed, 0);
}

TEST(ChildProcess, TellsWhatDoesNotEndWell) {
  EXPECT_FALSE(ends([] { throw std::runtime_error("not seen to"); }));
  EXPECT_FALSE(ends([] { std::raise(SIGSEGV); }));
  EXPECT_FALSE(ends([] { std::abort(); }));
  EXPECT_FALSE(ends([] {
    const volatile bool goes_on = true;
    while (goes_on) {
    }
  }));
}

TEST(ChildProcess, TellsWhatEndsTooEarlyOrLate) {
  int number = 0;
  const auto take = [&](PipeReader& pipe) { pipe(number), pipe(number); };
  EXPECT_FALSE(through_child([](PipeWriter& pipe) { pipe(1); }, take, seconds(1), memory));
  const auto without_end = [](PipeWriter& pipe) {
    for (;;) pipe(1);
  };
  EXPECT_FALSE(through_child(without_end, take, seconds(10), memory));
}

TEST(ChildProcess, DoesNotMakeItsParentTakeAllMemory) {
  std::vector<double> array;
  const auto give = [](PipeWriter& pipe) { pipe(std::uint64_t{1} << 60); };
  EXPECT_FALSE(through_child(
      give, [&](PipeReader& pipe) { pipe(array); }, seconds(1), memory));
}

TEST(ChildProcess, PassesOnWhatTheParentThrows) {
  const auto take = [](PipeReader&) { throw std::logic_error("the parent's own"); };
  EXPECT_THROW(through_child([](PipeWriter& pipe) { pipe(1); }, take, seconds(1), memory), std::logic_error);
}

TEST(ChildProcess, HasItsMemoryBounded) {
  if (!test::memory_can_be_limited) GTEST_SKIP() << "memory cannot be refused under this sanitizer";
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
