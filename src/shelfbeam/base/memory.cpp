#include "shelfbeam/base/memory.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <sys/resource.h>
#include <unistd.h>

namespace shelfbeam {
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::uint64_t limit_of_process(decltype(RLIMIT_AS) resource) {
  rlimit limit = {};
  return ::getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? limit.rlim_cur : unlimited;
}

// The number in a file; no limit if there is none ("max", or no such file).
std::uint64_t number_in(const fs::path& file) {
  std::uint64_t number = 0;
  return std::ifstream(file) >> number ? number : unlimited;
}

// The lowest limit of a group and of the groups that contain it.
std::uint64_t limit_of_groups(const fs::path& root, fs::path group, const char* name) {
  std::uint64_t limit = number_in(root / name);
  for (group = group.relative_path(); !group.empty(); group = group.parent_path())
    limit = std::min(limit, number_in(root / group / name));
  return limit;
}

// /proc/self/cgroup has a line "ID:CONTROLLERS:/GROUP" per hierarchy; without controllers it is version 2.
std::uint64_t limit_of_control_groups() {
  std::uint64_t limit = unlimited;
  std::ifstream list("/proc/self/cgroup");
  for (std::string line; std::getline(list, line);) {
    const auto first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const fs::path group = line.substr(second + 1);
    if (controllers.empty())
      limit = std::min(limit, limit_of_groups("/sys/fs/cgroup", group, "memory.max"));
    else if (("," + controllers + ",").find(",memory,") != std::string::npos)
      limit = std::min(limit, limit_of_groups("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return limit;
}

}  // namespace

std::size_t memory_limit() {
  static const std::uint64_t available = [] {
    const std::uint64_t physical = static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
                                   static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
    return std::min(
        {physical, limit_of_process(RLIMIT_AS), limit_of_process(RLIMIT_DATA), limit_of_control_groups()});
  }();
  return available / 10 * 8;
}

}  // namespace shelfbeam
