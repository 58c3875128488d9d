#pragma once

#include <cstddef>
#include <cstdint>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/kernels/search_effort.hpp"

namespace shelfbeam::detail {

/// Calls walk(number, seed, control) for every walk of `effort`, on `control.threads` threads. Only the first
/// one reports progress.
template <class Walk>
void for_each_walk(const SearchEffort& effort, const RunControl& control, const Walk& walk) {
  with_threads(control.threads, [&] {
    for_each_task(effort.walks, [&](std::size_t k) {
      walk(k, effort.seed + static_cast<std::uint32_t>(k),
           k == 0 ? control : RunControl{control.threads, control.cancel});
    });
  });
}

}  // namespace shelfbeam::detail
