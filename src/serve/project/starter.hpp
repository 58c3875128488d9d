#pragma once

#include <filesystem>

namespace shelfbeam::serve {

/// Writes store.json, an empty room, and catalogue.json, fixtures to draw, into a folder without a project.
/// Does nothing in a folder with any other files. Creates the folder. Throws OutputError.
void start_project(const std::filesystem::path& folder);

}  // namespace shelfbeam::serve
