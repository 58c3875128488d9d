#pragma once

#include <algorithm>
#include <chrono>

namespace shelfbeam {

/// A limit of time that starts to run when it is made.
class Deadline {
 public:
  using Clock = std::chrono::steady_clock;

  /// Beyond three years no limit is meant.
  explicit Deadline(double seconds)
      : end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(std::clamp(seconds, 0.0, 1e8)))) {}

  Clock::time_point end() const { return end_; }
  /// Negative once it has passed.
  double seconds_left() const { return std::chrono::duration<double>(end_ - Clock::now()).count(); }
  bool has_passed() const { return Clock::now() >= end_; }

 private:
  Clock::time_point end_;
};

}  // namespace shelfbeam
