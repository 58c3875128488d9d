#pragma once

#include <ctime>

namespace shelfbeam::test {

/// CPU time of this program since construction, in s. Unlike wall time, it does not depend on other programs
/// on the machine. For work on one thread.
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
