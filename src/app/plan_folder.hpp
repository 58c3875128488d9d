#pragma once

#include <filesystem>

#include "shelfbeam/report/report.hpp"

namespace shelfbeam::app {

/// Names of what a plan leaves in its folder.
inline constexpr auto signal_name = "signal.h5";
inline constexpr auto placement_name = "placement.json";
inline constexpr auto store_name = "store.json";
inline constexpr auto report_name = "report.html";

/// Writes report.html, labels.csv and placement.csv.
void write_report(const std::filesystem::path& folder, const ReportInput& input);

}  // namespace shelfbeam::app
