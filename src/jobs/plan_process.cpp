#include "jobs/plan_process.hpp"

#include <csignal>

#include <fmt/format.h>

#include "jobs/plan_job_json.hpp"

namespace shelfbeam::jobs {

namespace {

constexpr int signal_base = 128;

std::string_view last_line(std::string_view text) {
  if (text.ends_with('\n')) text.remove_suffix(1);
  return text.substr(text.rfind('\n') + 1);
}

// The end of a process that reported none.
JobError error_of(const ChildEnd& end) {
  const int signal = end.exit_code - signal_base;
  const bool is_interruption =
      end.exit_code == stopped_early || signal == SIGINT || signal == SIGTERM || signal == SIGHUP;
  return {internal_error,
          signal > 0 ? fmt::format("the plan was ended by signal {}", signal)
                     : fmt::format("the plan ended with exit code {}", end.exit_code),
          false, is_interruption};
}

}  // namespace

PlanProcess::PlanProcess(const PlanJob& job, std::uint64_t memory, const std::string& program)
    : child_({program, "job"}, memory, to_json(job)) {}

void PlanProcess::interrupt(std::optional<std::chrono::seconds> patience) {
  child_.interrupt();
  if (patience) deadline_ = Clock::now() + *patience;
}

bool PlanProcess::has_ended(JobEnd& end, ChildEnd& effort, ProgressSink* progress) {
  if (deadline_ && Clock::now() > *deadline_) child_.kill();
  if (progress != nullptr) {
    unread_ += child_.new_output();
    for (std::size_t at = 0; (at = unread_.find('\n')) != std::string::npos; unread_.erase(0, at + 1)) {
      has_read_ = has_read_ || unread_.starts_with(store_is_read);
      pass_on(std::string_view(unread_).substr(0, at), *progress);
    }
  }
  if (!child_.has_ended(effort)) return false;
  if (const auto found = read_end(last_line(effort.out)))
    end = *found;
  else
    end = error_of(effort);
  return true;
}

}  // namespace shelfbeam::jobs
