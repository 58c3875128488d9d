#pragma once

#include <algorithm>
#include <chrono>

namespace shelfbeam {

/// A time limit that starts when the object is constructed.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  /// Longer limits are cut to 1e8 s (three years), which is as good as no limit.
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e8)))) {}

  Clock::time_point end() const { return end_; }
  /// Negative after the deadline.
  double seconds_left() const { return std::chrono::duration<double>(end_ - Clock::now()).count(); }
  bool has_passed() const { return Clock::now() >= end_; }

 private:
  Clock::time_point end_;
};

/// Wall time since the object was constructed.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Deadline::Clock::now() - start_).count(); }

 private:
  Deadline::Clock::time_point start_ = Deadline::Clock::now();
};

}  // namespace shelfbeam
