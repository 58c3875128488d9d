#pragma once

#include <chrono>
#include <cstddef>
#include <functional>

namespace shelfbeam::detail {

/// Whether `action` comes to an end, by returning or by an exception: tried in a child process that begins as
/// a copy of this one, so that a crash, an endless loop or a full memory is the child's alone. For libraries
/// that trust files more than we may. The child can use `seconds` of a processor and `memory` bytes more than
/// it begins with. True also where no child can be made.
bool ends_well(const std::function<void()>& action, std::chrono::seconds seconds, std::size_t memory);

}  // namespace shelfbeam::detail
