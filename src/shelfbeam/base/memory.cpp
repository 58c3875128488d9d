#include "shelfbeam/base/memory.hpp"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include <sys/resource.h>
#include <unistd.h>

#include "shelfbeam/base/files/control_groups.hpp"

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

std::uint64_t limit_of_control_groups() {
  std::uint64_t limit = unlimited;
  for (const ControlGroup& group : control_groups("memory"))
    limit = std::min(limit,
                     number_in(group.folder / (group.version == 2 ? "memory.max" : "memory.limit_in_bytes")));
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
