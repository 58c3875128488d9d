#pragma once

namespace shelfbeam::app {

/// While it exists, a signal (cancel_on_signal) ends the program at once, with this exit code: reading has no
/// results that could be saved. Throws Interrupted if there was a signal before.
class EndAtOnce {
 public:
  explicit EndAtOnce(int exit_code);
  ~EndAtOnce();
  EndAtOnce(const EndAtOnce&) = delete;
  EndAtOnce& operator=(const EndAtOnce&) = delete;
};

}  // namespace shelfbeam::app
