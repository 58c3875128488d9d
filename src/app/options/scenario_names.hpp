#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace shelfbeam::app {

/// A name for each of several files: the end of its path, without the file's last ending, as short as tells
/// it from the others ("full/signal" and "empty/signal", but "day" and "night"). With the ending where only
/// that differs. The same file twice has one name twice.
std::vector<std::string> scenario_names(const std::vector<std::filesystem::path>& files);

}  // namespace shelfbeam::app
