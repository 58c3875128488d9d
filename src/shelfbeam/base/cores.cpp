#include "shelfbeam/base/cores.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <thread>

#include <sched.h>

#include "shelfbeam/base/files/control_groups.hpp"

namespace shelfbeam {

namespace detail {

double core_quota(const std::filesystem::path& system) {
  double cores = std::numeric_limits<double>::infinity();
  for (const ControlGroup& group : control_groups("cpu", system)) {
    // Microseconds of processor time in a period; "max" or -1 is no quota.
    double quota = 0, period = 0;
    if (group.version == 2)
      std::ifstream(group.folder / "cpu.max") >> quota >> period;
    else if (std::ifstream(group.folder / "cpu.cfs_quota_us") >> quota)
      std::ifstream(group.folder / "cpu.cfs_period_us") >> period;
    if (quota > 0 && period > 0) cores = std::min(cores, quota / period);
  }
  return cores;
}

}  // namespace detail

namespace {

// The standard library counts all cores, also those that `taskset` or a batch system keeps from this process.
unsigned allowed_cores() {
  cpu_set_t set;  // of 1024 cores; larger machines fail here
  if (::sched_getaffinity(0, sizeof set, &set) == 0) return static_cast<unsigned>(CPU_COUNT(&set));
  return std::thread::hardware_concurrency();
}

}  // namespace

unsigned core_count() {
  // A quota of half a core more is worth a thread.
  static const double quota = std::ceil(detail::core_quota());
  return static_cast<unsigned>(std::max(1.0, std::min<double>(allowed_cores(), quota)));
}

}  // namespace shelfbeam
