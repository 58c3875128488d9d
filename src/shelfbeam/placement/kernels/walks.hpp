#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/kernels/effort.hpp"

namespace shelfbeam::detail {

/// What a walk over selections has found: the best, ascending, and its cost; infinite where there is none.
struct Found {
  std::optional<std::vector<std::uint32_t>> selected;
  double cost = std::numeric_limits<double>::infinity();
};

/// The cheapest of what walk(seed, control) finds for `seed` and the seeds that follow it, the first of equal
/// ones, on `control.threads` threads. Only the first walk reports progress.
template <class Walk>
std::optional<std::vector<std::uint32_t>> best_of_walks(std::uint32_t seed, const RunControl& control,
                                                        const Walk& walk) {
  std::vector<Found> found(walks_at_once);
  with_threads(control.threads, [&] {
    for_each_task(found.size(), [&](std::size_t k) {
      found[k] = walk(seed + static_cast<std::uint32_t>(k),
                      k == 0 ? control : RunControl{control.threads, control.cancel});
    });
  });
  return std::min_element(found.begin(), found.end(),
                          [](const Found& a, const Found& b) { return a.cost < b.cost; })
      ->selected;
}

}  // namespace shelfbeam::detail
