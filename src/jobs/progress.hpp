#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "shelfbeam/base/control.hpp"

namespace shelfbeam::jobs {

/// The state of a task. A negative number is unknown.
struct Progress {
  Task task = Task::planning;
  double fraction = -1;
  double seconds = 0;  ///< since the task began
  double seconds_left = -1;
  std::string_view detail;
};

/// Predicts the end of a task from its share done.
class RemainingTime {
 public:
  /// In seconds, smoothed over jumps of the share; negative while too little is known. `now` is in seconds.
  double update(double fraction, double now);

 private:
  double first_ = -1;  ///< the share at begun_; negative: not begun
  double begun_ = 0, last_fraction_ = 0, last_ = 0, end_ = -1;
};

/// Combines the reports of a run. Simulations and searches that a later stage needs, such as "verifying", are
/// shown as steps of that stage.
class ProgressStages {
 public:
  /// The text of the result is valid until the next call.
  Progress update(Task task, double fraction, std::string_view detail, double now);

 private:
  std::optional<Task> shown_;
  std::optional<Task> step_;  ///< the task that was reported last
  std::string detail_;
  double stage_fraction_ = -1;  ///< that the stage itself reports
  bool in_stage_ = false;
  double begun_ = 0;
  RemainingTime remaining_;
};

}  // namespace shelfbeam::jobs
