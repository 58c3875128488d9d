#pragma once

#include <string>
#include <vector>

#include "shelfbeam/report/batch/store_result.hpp"

#include "jobs/plan_job.hpp"

namespace shelfbeam::jobs {

/// The result of a plan in a few values, for lists of plans.
struct PlanSummary : PlanNumbers {
  ExitCode code = done;
  std::vector<std::string> selected = {};  ///< ids of the chosen units
};

PlanSummary summary_of(const PlanEnd& end);

}  // namespace shelfbeam::jobs
