#pragma once

#include <filesystem>

namespace shelfbeam::jobs {

/// Rebuilds the report, the mounting files and the tables in the folder of a plan, all or none, and returns
/// the path of the report. Throws InputError if the folder contains no plan, or if one of the files was
/// changed since; OutputError if a file cannot be written.
std::filesystem::path rebuild_report(const std::filesystem::path& folder, bool safe_csv);

}  // namespace shelfbeam::jobs
