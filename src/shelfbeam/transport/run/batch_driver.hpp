#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/transport/tally/estimator.hpp"

namespace shelfbeam::detail {

/// Computes batches of an estimator's items, many at a time, and delivers them in order.
class BatchDriver {
 public:
  /// Calls `sampled` after every batch of an item, from any thread.
  BatchDriver(
      const Scene& scene, const Estimator& estimator, const RunControl& control,
      std::function<void()> sampled = [] {})
      : scene_(scene), estimator_(estimator), control_(control), sampled_(std::move(sampled)) {}

  /// Number of batches per item to compute at once: several if items are few, so that threads need not wait
  /// for the largest item.
  static std::uint32_t at_once(std::size_t items) {
    constexpr std::size_t enough_tasks = 16;
    return static_cast<std::uint32_t>(std::max<std::size_t>(1, enough_tasks / items));
  }

  /// Computes `count` batches of each item, from batch `first` on, on the threads of the current arena. Calls
  /// take(item, batch, values) for the batches of an item in order, and for different items from several
  /// threads. Once all items have delivered a batch, goes_on(batch) returns whether to deliver the next one
  /// or to discard the rest. When cancelled, no item delivers more than its first batch.
  template <class Take, class GoesOn>
  void run(std::span<const std::uint32_t> items, std::uint32_t first, std::uint32_t count, const Take& take,
           const GoesOn& should_continue) {
    const std::size_t n = items.size();
    if (count > 1 && waiting_.size() < n * count) waiting_.resize(n * count);
    is_complete_.assign(n * count, 0);
    parallel_for_ranges(n * count, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end && !control_.cancelled(); ++k) {
        const std::uint32_t item = items[k % n], batch = first + static_cast<std::uint32_t>(k / n);
        BatchValues& values = count > 1 ? waiting_[k] : values_.local();
        if (!sample(item, batch, values)) return;
        is_complete_[k] = 1;
        if (count == 1) take(item, batch, values);
      }
    });
    for (std::uint32_t b = 0; b < count; ++b) {
      if (count > 1)
        parallel_for_ranges(n, [&](std::size_t begin, std::size_t end) {
          for (std::size_t k = begin; k < end; ++k)
            if (is_complete_[b * n + k] != 0) take(items[k], first + b, waiting_[b * n + k]);
        });
      if (!should_continue(first + b) || control_.cancelled()) return;
    }
  }

  /// Totals over all computed batches, discarded ones included.
  std::uint64_t batches() const { return batches_; }
  std::uint64_t rays() const { return rays_; }
  const ShadowRays& shadow_rays() const { return shadow_rays_; }

 private:
  bool sample(std::uint32_t item, std::uint32_t batch, BatchValues& values) {
    values.clear();
    values.rays = 0;
    values.shadow_rays = {};
    if (!estimator_.sample(item, batch, control_.cancel, values)) return false;
    expect_numbers(scene_, estimator_.block(item), values);
    rays_.fetch_add(values.rays, std::memory_order_relaxed);
    {
      const std::scoped_lock lock(shadow_rays_mutex_);
      shadow_rays_ += values.shadow_rays;
    }
    batches_.fetch_add(1, std::memory_order_relaxed);
    sampled_();
    return true;
  }

  const Scene& scene_;
  const Estimator& estimator_;
  const RunControl& control_;
  std::function<void()> sampled_;
  tbb::enumerable_thread_specific<BatchValues> values_;
  std::vector<BatchValues> waiting_;
  std::vector<char> is_complete_;
  std::atomic<std::uint64_t> batches_{0}, rays_{0};
  ShadowRays shadow_rays_;
  std::mutex shadow_rays_mutex_;
};

}  // namespace shelfbeam::detail
