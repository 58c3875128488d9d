#pragma once

#include <filesystem>
#include <optional>

#include "jobs/stored_plan.hpp"

namespace shelfbeam::jobs {

/// The path of a store file from the folder of its plan, for run.json; empty for a store that is no file.
std::string store_from(const std::filesystem::path& folder, const std::filesystem::path& store);

/// The store file of a plan as run.json names it, if it is still there; nothing for earlier versions.
std::optional<std::filesystem::path> store_of_plan(const std::filesystem::path& folder);

/// Gives the values of a plan the states that they have in `now`, the shop as it is, where they have not
/// changed since. Values of plans up to version 0.4 count as given unless they are confirmed now. Returns
/// whether a state differs.
bool renew_values(StoredPlan& stored, const Scene& now);

}  // namespace shelfbeam::jobs
