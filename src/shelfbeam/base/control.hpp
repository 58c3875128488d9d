#pragma once

#include <atomic>
#include <string>
#include <string_view>

namespace shelfbeam {

/// Cancels long work. Any thread and a signal handler may set it. The work checks it between steps and then
/// ends early with its results so far.
class CancelToken {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

/// Receives the progress of long work. Only one thread calls it at a time.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` is in [0, 1], or negative when the end is unknown; `detail` is a short free text.
  virtual void report(std::string_view task, double fraction, std::string_view detail) = 0;
  /// The value of the best placement so far and a proven lower bound; comes before a report.
  virtual void bounds(double /*incumbent*/, double /*lower_bound*/) {}
};

/// Threads, cancellation and progress of a long computation. All are optional, and none changes a result.
struct RunControl {
  unsigned threads = 0;  ///< 0: all cores
  const CancelToken* cancel = nullptr;
  ProgressSink* progress = nullptr;

  bool cancelled() const { return cancel != nullptr && cancel->requested(); }
  void report(std::string_view task, double fraction, std::string_view detail = {}) const {
    if (progress != nullptr) progress->report(task, fraction, detail);
  }
};

}  // namespace shelfbeam
