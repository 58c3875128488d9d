#pragma once

#include <chrono>
#include <string>
#include <string_view>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::app {

/// A progress line with the time remaining on standard error; silent when that is no terminal.
class TerminalProgress : public ProgressSink {
 public:
  explicit TerminalProgress(bool quiet);
  ~TerminalProgress() override;
  /// Itself, or nothing where nobody watches.
  ProgressSink* sink() { return active_ ? this : nullptr; }
  void report(std::string_view task, double fraction, std::string_view detail) override;

 private:
  using Clock = std::chrono::steady_clock;
  void clear();

  bool active_;
  bool drawn_ = false;
  double first_ = 0;  ///< the fraction that the task began with
  std::string task_;
  Clock::time_point started_, last_;
};

/// Makes Ctrl-C, SIGTERM and a terminal that goes away ask the running work to end with what it has; a second
/// Ctrl-C ends the program.
const CancelToken& cancel_on_signal();

}  // namespace shelfbeam::app
