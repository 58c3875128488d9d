#include "shelfbeam/base/files/control_groups.hpp"

#include <fstream>
#include <string>

namespace shelfbeam {
namespace fs = std::filesystem;

// /proc/self/cgroup has a line "ID:CONTROLLERS:/GROUP" per hierarchy; without controllers it is version 2.
std::vector<ControlGroup> control_groups(std::string_view controller, const fs::path& system) {
  std::vector<ControlGroup> groups;
  std::ifstream list(system / "proc/self/cgroup");
  for (std::string line; std::getline(list, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const bool is_unified = controllers == ",,";
    if (!is_unified && controllers.find("," + std::string(controller) + ",") == std::string::npos) continue;
    const fs::path root = is_unified ? system / "sys/fs/cgroup" : system / "sys/fs/cgroup" / controller;
    const int version = is_unified ? 2 : 1;
    // A container may see its own group as the root, but the name that the group has outside.
    groups.push_back({root, version});
    for (fs::path group = fs::path(line.substr(second + 1)).relative_path(); !group.empty();
         group = group.parent_path())
      groups.push_back({root / group, version});
  }
  return groups;
}

}  // namespace shelfbeam
