#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace shelfbeam {

/// A control group that contains this process; containers and batch systems set limits in them.
struct ControlGroup {
  std::filesystem::path folder;
  int version = 2;
};

/// The control groups of the process for a controller ("memory", "cpu"), and those that contain them.
/// `system` has the folders proc and sys.
std::vector<ControlGroup> control_groups(std::string_view controller,
                                         const std::filesystem::path& system = "/");

}  // namespace shelfbeam
