#pragma once

#include <cxxabi.h>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::python {

// The calls at work without the interpreter's lock, so that its end and forks of the process find them.

/// A call until the end of its work. Requires the lock.
class RunningCall {
 public:
  /// Raises RuntimeError in a process that was forked while calls were at work: it lacks their threads, which
  /// may have held locks. Does not return after `end_calls` on another thread.
  explicit RunningCall(CancelToken& cancel);
  ~RunningCall();  ///< on any thread, without the lock
  RunningCall(const RunningCall&) = delete;
  RunningCall& operator=(const RunningCall&) = delete;

 private:
  CancelToken& cancel_;
};

/// Raises the RuntimeError of such a process.
[[noreturn]] void refuse_fork();

/// Registered with atexit: cancels all calls, and waits for the end of their work, but not for ever. Later
/// calls of other threads wait for the end of the process.
void end_calls();
/// Whether `end_calls` was called on another thread.
bool are_over();

/// Waits for the end of the process.
[[noreturn]] void wait_for_exit();

/// `work` of the interpreter. While it ends, it ends a thread that takes its lock by unwinding the stack,
/// which frames of C++ do not survive: the thread waits for the end of the process instead.
template <class Work>
auto in_interpreter(const Work& work) {
  try {
    return work();
  } catch (abi::__forced_unwind&) {
    wait_for_exit();
  }
}

}  // namespace shelfbeam::python
