#pragma once

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace shelfbeam::serve {

/// Sizes and times of the files that a store names, relative to its folder: another text means that other
/// programs have changed some of them.
std::string state_of_named_files(const nlohmann::ordered_json& store, const std::filesystem::path& folder);

}  // namespace shelfbeam::serve
