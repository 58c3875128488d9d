#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "shelfbeam/plan/plan.hpp"
#include "shelfbeam/report/data/report.hpp"
#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/scene/store/store.hpp"

#include "jobs/plan_folder.hpp"

namespace shelfbeam::jobs {

/// A plan with all that its files contain.
struct PlanContents {
  const Store& store;
  const Scene& scene;
  const std::string& resolved;  ///< the resolved store
  const Plan& plan;
  const std::string& answer;  ///< placement.json without its record
  const std::string& run;     ///< run.json
  bool safe_csv = false;
};

/// Adds labels.csv, placement.csv, the mounting files and report.html.
void add_report(AtomicFolder& files, const ReportInput& input);

/// Writes all files of a plan, or none, to the folder of its run. A plan that cannot be written there is kept
/// elsewhere, and the OutputError that is thrown names the place.
void write_plan(const PlanFolder& folder, const std::filesystem::path& path, const PlanContents& contents);

/// Writes all files to a new folder elsewhere, and returns it; nothing if this is impossible.
std::optional<std::filesystem::path> keep_plan_elsewhere(const PlanContents& contents);

}  // namespace shelfbeam::jobs
