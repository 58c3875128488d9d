#pragma once

#include <atomic>
#include <cstddef>
#include <stdexcept>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "shelfbeam/base/cores.hpp"

namespace shelfbeam {

/// Calls body(first, last) in parallel for parts of the range [0, count), in the current arena. The oneTBB
/// partitioner chooses the parts.
///
/// The atomics make writes before the loop visible to every body, and writes of the bodies visible after the
/// loop. oneTBB guarantees both as well, but inside its prebuilt library, hidden from the thread sanitizer.
template <class Body, class Partitioner = tbb::auto_partitioner>
void parallel_for_ranges(std::size_t count, Body body, Partitioner partitioner = {}) {
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
  if (ended.load(std::memory_order_acquire) != count) throw std::logic_error("parts of a loop were omitted");
}

/// Calls body(k) for k = 0 ... count - 1, each as a separate task. Meant for few, long tasks.
template <class Body>
void for_each_task(std::size_t count, Body body) {
  const auto part = [&](std::size_t first, std::size_t last) {
    for (std::size_t k = first; k < last; ++k) body(k);
  };
  parallel_for_ranges(count, part, tbb::simple_partitioner());
}

/// Calls body() in an arena with this number of threads (0: `core_count`).
template <class Body>
auto with_threads(unsigned threads, const Body& body) {
  tbb::task_arena arena(static_cast<int>(threads == 0 ? core_count() : threads));
  return arena.execute(body);
}

/// Makes oneTBB create this number of threads (0: `core_count`), even if there are fewer cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads)
      : limit_(tbb::global_control::max_allowed_parallelism, threads == 0 ? core_count() : threads) {}

 private:
  tbb::global_control limit_;
};

}  // namespace shelfbeam
