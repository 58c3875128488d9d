#pragma once

#include <cstddef>

#include "shelfbeam/base/error.hpp"

namespace shelfbeam {

/// Default memory limit, bytes: 80 % of the memory that this process may use; the rest is for other purposes.
/// The physical memory, the limits of the process (ulimit -v and -d) and those of its control groups
/// (containers) are taken into account.
std::size_t memory_limit();

/// An input that requires more memory than this process may use. Another process may have more.
class MemoryError : public InputError {
 public:
  using InputError::InputError;
};

}  // namespace shelfbeam
