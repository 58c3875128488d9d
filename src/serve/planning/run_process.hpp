#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "shelfbeam/base/control.hpp"

#include "jobs/plan_process.hpp"
#include "jobs/progress.hpp"
#include "serve/planning/plan_run.hpp"

namespace shelfbeam::serve {

/// Throws InputError if the request of a run is none.
void expect_request(const PlanRun& run);

/// The process of a run: first that of its first answer, then that of the plan.
class RunProcess : ProgressSink {
 public:
  /// `store`: the store file. `signal`: the folder of an earlier plan, whose signals are reused if they fit;
  /// empty: none. Throws InputError for a request that is none.
  RunProcess(PlanRun& run, const std::filesystem::path& store, const std::string& signal,
             std::string program);

  /// Ends the first answer at once, and the plan with its results so far.
  void cancel();
  /// Starts, also again, with a store that has changed before it was read. A run whose process cannot be
  /// started has failed.
  void start();
  /// Whether a process is running that has not read the store yet.
  bool may_start_again() const { return process_ && !is_cancelled_ && !process_->has_read(); }
  /// To be called often. Updates the run; returns whether it has changed. A run that is not active any more
  /// has no process.
  bool poll();

 private:
  struct Incumbent {
    double value = 0, bound = 0;
    std::vector<std::string> selected = {};
  };

  void take(const Incumbent& found);
  void end(const jobs::JobEnd& end);
  void report(Task task, double fraction, std::string_view detail) override;
  void bounds(double incumbent, double lower_bound) override;
  void selection(const std::vector<std::string>& ids) override;

  PlanRun& run_;
  jobs::PlanJob job_;
  std::string program_;
  std::optional<jobs::PlanProcess> process_;
  jobs::ProgressStages stages_;
  std::chrono::steady_clock::time_point begun_;
  std::optional<std::pair<double, double>> reported_;  // incumbent and bound, before their task
  std::vector<std::string> selected_;                  // of the last incumbent
  std::optional<Incumbent> withheld_;                  // worse than that of an earlier placement
  Task bounded_ = Task::placing;                       // the task of the last bounds
  bool is_cancelled_ = false, has_changed_ = false;
};

}  // namespace shelfbeam::serve
