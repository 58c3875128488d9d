#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

#include "shelfbeam/signal/hdf5/pipe.hpp"

namespace shelfbeam::detail {

/// Runs `give` in a child process that begins as a copy of this one, and `take` here, at the other end of a
/// pipe between them: a crash, an endless loop, a full or spoilt memory is the child's alone. For libraries
/// that trust files more than we may. The child can use `seconds` of a processor and `memory` bytes more than
/// it begins with. False where the child did not come to the end of `give`, or `take` met a BrokenPipe; what
/// else `take` throws is passed on. `give` has to see to its exceptions: what it throws is taken for a crash.
/// Throws std::system_error where no child can be made.
bool through_child(const std::function<void(PipeWriter&)>& give, const std::function<void(PipeReader&)>& take,
                   std::chrono::seconds seconds, std::size_t memory);

}  // namespace shelfbeam::detail
