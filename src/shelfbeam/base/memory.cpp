#include "shelfbeam/base/memory.hpp"

#include <unistd.h>

namespace shelfbeam {

std::size_t most_of_the_memory() {
  return static_cast<std::size_t>(::sysconf(_SC_PHYS_PAGES)) / 10 * 8 *
         static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

}  // namespace shelfbeam
