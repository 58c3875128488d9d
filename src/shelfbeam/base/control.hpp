#pragma once

#include <atomic>
#include <string>
#include <string_view>

namespace shelfbeam {

/// Set from anywhere (a signal handler included); long work looks at it between steps and ends early with
/// what it has.
class CancelToken {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  bool requested() const noexcept { return requested_.load(std::memory_order_relaxed); }

 private:
  std::atomic<bool> requested_{false};
};

/// Where long work reports how far it is. Called from one thread at a time.
class ProgressSink {
 public:
  virtual ~ProgressSink() = default;
  /// `fraction` in [0, 1], or negative where the end cannot be known; `detail` is a short free text.
  virtual void report(std::string_view task, double fraction, std::string_view detail) = 0;
};

/// What accompanies every long computation; all of it optional, none of it changes a result.
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
