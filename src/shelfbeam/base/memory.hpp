#pragma once

#include <cstddef>

#include <unistd.h>

namespace shelfbeam {

/// Default memory limit, bytes: 80 % of the physical memory; the rest is for other processes.
inline std::size_t memory_limit() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 10 * 8 *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace shelfbeam
