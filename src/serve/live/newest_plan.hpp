#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace shelfbeam::serve {

/// Whether the path is a regular file, and no link.
bool is_plain_file(const std::filesystem::path& path);

/// When the plan in a folder was finished; nothing if there is none. Links are not followed.
std::optional<std::filesystem::file_time_type> time_of_plan(const std::filesystem::path& folder);

/// The name of the folder of the plan that was finished last in the folder of a project; empty if there is
/// none. Links are not followed.
std::string newest_plan(const std::filesystem::path& folder);

}  // namespace shelfbeam::serve
