#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "jobs/plan_job.hpp"

namespace shelfbeam::jobs {

/// The result of a plan in a few values, for lists of plans.
struct PlanSummary {
  ExitCode code = done;
  std::string answer;  ///< one sentence, without the scope of its confidence
  std::uint64_t labels = 0;
  std::optional<std::uint64_t> units, lower_bound;  ///< of a placement
  std::optional<double> price;                      ///< of the new units
  std::string currency;                             ///< empty: not given
  std::vector<std::string> warnings;
};

PlanSummary summary_of(const PlanEnd& end);

}  // namespace shelfbeam::jobs
