#pragma once

#include "jobs/plan_job.hpp"

namespace shelfbeam::jobs {

/// Time limit of the placement of a first answer, s.
inline constexpr double first_answer_s = 4;

/// A first answer to a job within seconds, without a simulation and without a file: units placed on the
/// signals of `job.signal` if they fit, and otherwise on previews by a light operator in the folder
/// `job.preview`, the usual one if it is kept there, and otherwise a coarse one, which is then kept. The
/// shop is the one that the store file gives, without states. Throws as run_plan, and Interrupted when
/// cancelled before there is a placement.
PlanEnd run_first_answer(const PlanJob& job, const JobWatch& watch);

}  // namespace shelfbeam::jobs
