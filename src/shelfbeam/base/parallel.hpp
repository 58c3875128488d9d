#pragma once

#include <atomic>
#include <cstddef>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace shelfbeam {

/// Calls body(first, last) for parts of 0 ... count - 1, each on some thread of the present arena, divided as
/// the partitioner of oneTBB does.
///
/// What came before the loop is seen by every body, and what the bodies did is seen after it. oneTBB sees to
/// that, too, but inside its prebuilt library, where the thread sanitizer cannot follow.
template <class Body, class Partitioner = tbb::auto_partitioner>
void for_parts(std::size_t count, Body body, Partitioner partitioner = {}) {
  std::atomic<bool> begun{false};
  std::atomic<std::size_t> ended{0};
  begun.store(true, std::memory_order_release);
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count),
      [&](const auto& range) {
        if (!begun.load(std::memory_order_acquire)) return;
        body(range.begin(), range.end());
        ended.fetch_add(range.size(), std::memory_order_acq_rel);
      },
      partitioner);
  if (ended.load(std::memory_order_acquire) != count) throw std::logic_error("parts of a loop were left out");
}

/// Calls body(k) for k = 0 ... count - 1, each a task of its own: for few and long ones.
template <class Body>
void for_each_task(std::size_t count, Body body) {
  const auto part = [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) body(k);
  };
  for_parts(count, part, tbb::simple_partitioner());
}

/// Calls body() in an arena of so many threads (0: one a core).
template <class Body>
auto with_threads(unsigned threads, const Body& body) {
  tbb::task_arena arena(threads == 0 ? tbb::task_arena::automatic : static_cast<int>(threads));
  return arena.execute(body);
}

/// While it lives, as many threads are made as are asked for (0: one a core), however few cores there are.
class ThreadsAllowed {
 public:
  explicit ThreadsAllowed(unsigned threads)
      : limit_(tbb::global_control::max_allowed_parallelism,
               threads == 0 ? static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) : threads) {}

 private:
  tbb::global_control limit_;
};

}  // namespace shelfbeam
