#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "shelfbeam/scene/read_scene.hpp"

namespace shelfbeam::serve {

/// What the page shows of a file before the store uses it (docs/formats/planner.md): the shape of an emission
/// profile as `photometry`, or the size and the materials of a mesh as `mesh`; an empty object for any other
/// file. `name`: in the folder. Throws InputError for files that the store could not use.
nlohmann::ordered_json facts_of_file(const std::filesystem::path& folder, const std::string& name,
                                     const StoreLimits& limits);

/// Keeps a file that a page brings (keep_file), and returns the answer for it: `file`, the size of a picture,
/// and facts_of_file. Throws InputError; a file that no store could use is not kept.
nlohmann::ordered_json keep_with_facts(const std::filesystem::path& folder, std::string_view name,
                                       std::string_view content, const StoreLimits& limits);

}  // namespace shelfbeam::serve
