#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/base/parallel.hpp"
#include "shelfbeam/placement/problem/effort.hpp"
#include "shelfbeam/placement/problem/placement_problem.hpp"

namespace shelfbeam::detail {

/// Walks of one local search that run side by side, each with its own seed.
inline constexpr std::uint32_t walks_at_once = 2;

/// The best selection of a walk, ascending, and its cost; infinite if there is none.
struct Found {
  std::optional<Selection> selected;
  double cost = std::numeric_limits<double>::infinity();
};

/// The cheapest selection of the walks with `seed` and the following seeds, the first of equal ones, on
/// `control.threads` threads. Only the first walk reports progress.
template <class MakeWalk>
std::optional<Selection> best_of_walks(std::uint32_t seed, const Effort& effort, const RunControl& control,
                                       const MakeWalk& make_walk) {
  std::vector<Found> found(walks_at_once);
  with_threads(control.threads, [&] {
    for_each_task(found.size(), [&](std::size_t k) {
      auto walk = make_walk(seed + static_cast<std::uint32_t>(k));
      walk.run(effort, k == 0 ? control : RunControl{control.threads, control.cancel});
      found[k] = walk.best();
    });
  });
  return std::ranges::min_element(found, {}, &Found::cost)->selected;
}

}  // namespace shelfbeam::detail
