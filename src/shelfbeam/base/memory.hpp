#pragma once

#include <cstddef>

namespace shelfbeam {

/// Bytes that may be used unless told otherwise: what the machine has, but for what others need.
std::size_t most_of_the_memory();

}  // namespace shelfbeam
