#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "shelfbeam/base/control.hpp"

#include "jobs/plan_summary.hpp"
#include "jobs/progress.hpp"

namespace shelfbeam::jobs {

// A job reports its progress and its end as lines of JSON (docs/formats/job.md).

/// An error that ended a job.
struct JobError {
  ExitCode code = internal_error;
  std::string message;
  bool is_of_checkpoint = false;  ///< the checkpoint is damaged, or of another run
  bool is_interruption = false;
};

/// The result of a job.
struct JobResult {
  PlanSummary summary;
  bool is_complete = false;  ///< not interrupted
};

using JobEnd = std::variant<JobResult, JobError>;

ExitCode exit_code_of(const JobEnd& end);

/// The line of the event after which a job no longer depends on the store file.
inline constexpr std::string_view store_is_read = "{\"event\":\"read\"}\n";

JobError error_of(const std::exception& error);
std::string line_of(const JobEnd& end);
/// Nothing for another line.
std::optional<JobEnd> read_end(std::string_view line);

/// Writes progress as lines of JSON, at most four per second. Bounds and selections are those of the task
/// itself, not of searches that are steps of it.
class EventProgress : public ProgressSink {
 public:
  using Write = std::function<void(std::string_view line)>;
  explicit EventProgress(Write write) : write_(std::move(write)) {}

  void report(Task task, double fraction, std::string_view detail) override;
  void bounds(double incumbent, double lower_bound) override;
  void selection(const std::vector<std::string>& ids) override;

 private:
  using Clock = std::chrono::steady_clock;
  struct Bounds {
    std::optional<double> incumbent, lower;
    std::optional<std::vector<std::string>> selected;
  };

  void write(const Progress& progress);

  Write write_;
  ProgressStages stages_;
  Clock::time_point begun_ = Clock::now();
  std::optional<Clock::time_point> written_;
  Bounds bounds_, next_;  ///< of the task that is shown, and of the next report
  std::optional<Progress> shown_;
  bool has_unwritten_bounds_ = false;  ///< of the task that is shown
  std::vector<std::string> written_selection_;
};

/// The progress in a line, passed on to `sink`. False for another line.
bool pass_on(std::string_view line, ProgressSink& sink);

}  // namespace shelfbeam::jobs
