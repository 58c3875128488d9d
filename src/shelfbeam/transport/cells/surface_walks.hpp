#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/transport/cells/cell_division.hpp"
#include "shelfbeam/transport/world/world.hpp"

namespace shelfbeam::detail {

/// Where walks start that find the surfaces of a shop.
enum class CellSearch {
  labels,
  units,      ///< labels, and units that light mostly other surfaces, as in a back room with one door
  everywhere  ///< labels, and all surfaces found
};

/// A point that a walk has met, with a random rank among the points of its cell and quadrant (CellGrid).
struct FoundPoint {
  std::uint64_t key;
  std::uint32_t quadrant, rank;
  SurfacePoint point;

  bool operator<(const FoundPoint& other) const {
    return std::tie(key, quadrant, rank) < std::tie(other.key, other.quadrant, other.rank);
  }
};

struct FoundSurfaces {
  std::vector<FoundPoint> points;      ///< sorted
  std::vector<CloseUnit> close_units;  ///< after a search for units
  bool any_hidden = false;             ///< whether walks from units had to add cells
};

/// Walks on the threads of the current arena; ends early when cancelled.
FoundSurfaces find_surfaces(const World& world, std::uint64_t seed, CellSearch search,
                            const RunControl& control);

}  // namespace shelfbeam::detail
