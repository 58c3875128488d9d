#pragma once

#include <filesystem>
#include <optional>

namespace shelfbeam::jobs {

/// Rebuilds the report, the mounting files and the tables in the folder of a plan, all or none, and returns
/// the path of the report. Values that the file `store` confirms count as confirmed; by default, the file
/// from which the plan was made, as far as it can be read. Throws InputError if the folder contains no plan,
/// or if one of the files was changed since; OutputError if a file cannot be written.
std::filesystem::path rebuild_report(const std::filesystem::path& folder, bool safe_csv,
                                     const std::optional<std::filesystem::path>& store = {});

}  // namespace shelfbeam::jobs
