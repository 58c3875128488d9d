#pragma once

#include <filesystem>

#include "shelfbeam/base/file.hpp"
#include "shelfbeam/report/data/report.hpp"

namespace shelfbeam::app {

/// Names of what a plan leaves in its folder. A folder without placement.json is no whole plan.
inline constexpr auto signal_name = "signal.h5";
inline constexpr auto placement_name = "placement.json";
inline constexpr auto store_name = "store.json";
inline constexpr auto labels_name = "labels.csv";
inline constexpr auto placement_table_name = "placement.csv";
inline constexpr auto verification_name = "verification.csv";
inline constexpr auto report_name = "report.html";

/// Makes the folder; throws InputError where one of the files above could not be written.
void prepare_plan_folder(const std::filesystem::path& folder);

/// Adds labels.csv, placement.csv and report.html.
void write_report(AtomicFolder& files, const ReportInput& input);

}  // namespace shelfbeam::app
