#pragma once

#include <cstddef>

#include <unistd.h>

namespace shelfbeam {

/// Bytes that may be used unless told otherwise: what the machine has, but for what others need.
inline std::size_t most_of_the_memory() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 10 * 8 *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace shelfbeam
