#include "jobs/progress.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace shelfbeam::jobs {

namespace {

// The stages of `plan` and `verify` that simulate and search by steps.
constexpr std::array stages{Task::simulating_states,
                            Task::placing_over_states,
                            Task::fresh_states,
                            Task::verifying,
                            Task::proving,
                            Task::refining,
                            Task::curve,
                            Task::sensitivity};

}  // namespace

double RemainingTime::update(double fraction, double now) {
  const bool has_restarted = first_ < 0 || fraction < 0.5 * last_fraction_;
  if (fraction < 0 || has_restarted) {
    first_ = fraction;
    begun_ = now;
    end_ = -1;
  }
  const double elapsed = now - begun_, done = fraction - first_, since_last = now - last_;
  last_ = now;
  last_fraction_ = fraction;
  if (fraction >= 0 && done >= 0.01 && elapsed >= 1) {
    const double left = elapsed * (1 - fraction) / done;
    const double inertia = std::max(2.0, 0.1 * left);  // seconds
    const double weight = end_ < 0 ? 1 : 1 - std::exp(-since_last / inertia);
    end_ = end_ < 0 ? now + left : end_ + weight * (now + left - end_);
  }
  return end_ < 0 ? -1 : std::max(0.0, end_ - now);
}

Progress ProgressStages::update(Task task, double fraction, std::string_view detail, double now) {
  const bool is_stage = std::find(stages.begin(), stages.end(), task) != stages.end();
  in_stage_ = in_stage_ || is_stage;
  const bool is_step = in_stage_ && !is_stage;
  if (!is_step) {
    if (task != shown_) {
      begun_ = now;
      remaining_ = {};
    }
    shown_ = task;
    detail_ = detail;
    stage_fraction_ = fraction;
  } else if (stage_fraction_ >= 0) {
    fraction = stage_fraction_;
  } else if (task != step_) {  // a stage without a share of its own shows that of its steps
    remaining_ = {};
  }
  step_ = task;
  return {*shown_, fraction, now - begun_, remaining_.update(fraction, now), detail_};
}

}  // namespace shelfbeam::jobs
