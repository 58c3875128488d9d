#pragma once

#include <filesystem>
#include <optional>

#include "jobs/stored_plan.hpp"

namespace shelfbeam::jobs {

/// The path of a store file from the folder of its plan, for run.json; empty if the store did not come from a
/// file.
std::string store_from(const std::filesystem::path& folder, const std::filesystem::path& store);

/// The store file of a plan as run.json names it, relative to the folder; empty without a file, nothing for
/// plans of earlier versions.
std::optional<std::string> store_of_plan(const std::filesystem::path& folder);

/// Gives the values of a plan the states that they have in `now`, the shop as it is, where they have not
/// changed since, and whether its values are invented. Values of a plan of an earlier version (`is_old`)
/// count as given unless they are confirmed. Returns whether a state differs.
bool renew_values(StoredPlan& stored, const Scene& now, bool is_old);

}  // namespace shelfbeam::jobs
