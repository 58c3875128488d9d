#pragma once

#include <ctime>

namespace shelfbeam::test {

/// Seconds of processor time of this program since it was made: what a limit of time is held to, however many
/// other programs share the machine. For work on one thread.
class ProcessorTime {
 public:
  double seconds() const { return now() - begin_; }

 private:
  static double now() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  }
  double begin_ = now();
};

}  // namespace shelfbeam::test
