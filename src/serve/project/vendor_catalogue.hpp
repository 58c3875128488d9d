#pragma once

#include <filesystem>

#include "serve/project/project.hpp"

namespace shelfbeam::serve {

/// Copies a catalogue into the folder of a project, and enters it in store.json as a step of the history, as
/// far as neither has been done. Throws InputError for a file that is not a catalogue, and if the folder has
/// another file of its name; OutputError.
void add_catalogue(const std::filesystem::path& file, const std::filesystem::path& folder, Project& project);

}  // namespace shelfbeam::serve
