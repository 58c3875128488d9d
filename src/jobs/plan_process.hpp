#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "jobs/child.hpp"
#include "jobs/event.hpp"
#include "jobs/plan_job.hpp"

namespace shelfbeam::jobs {

/// A plan in a child process of this program, whose failure harms nothing else.
class PlanProcess {
 public:
  /// `memory`: limit of its data in bytes; 0: none. `program`: another one for tests. Throws
  /// std::system_error.
  PlanProcess(const PlanJob& job, std::uint64_t memory, const std::string& program = own_program);

  /// Asks it to end with its results so far. If it has not ended after the `patience`, `has_ended` kills it.
  void interrupt(std::optional<std::chrono::seconds> patience = {});
  /// Whether it has ended; then fills `end`, an error if it was killed, and `effort`. Passes its progress
  /// since the last call on to `progress`.
  bool has_ended(JobEnd& end, ChildEnd& effort, ProgressSink* progress = nullptr);
  /// Whether it has read the store, as far as `has_ended` with a `progress` knows.
  bool has_read() const { return has_read_; }
  /// Other processes come first from now on.
  void give_way() const { child_.give_way(); }

 private:
  using Clock = std::chrono::steady_clock;

  Child child_;
  std::optional<Clock::time_point> deadline_;  ///< it is killed then
  std::string unread_;                         ///< the beginning of a line
  bool has_read_ = false;
};

}  // namespace shelfbeam::jobs
