#pragma once

#include <string>

#include "jobs/plan_job.hpp"

namespace shelfbeam::jobs {

/// The job as JSON (docs/formats/job.md). Values that have their defaults are omitted.
std::string to_json(const PlanJob& job);

/// Throws InputError that names the text as `name`.
PlanJob parse_plan_job(const std::string& text, const std::string& name);

}  // namespace shelfbeam::jobs
