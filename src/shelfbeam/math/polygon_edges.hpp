#pragma once

#include <cstddef>

#include "shelfbeam/math/polygon.hpp"

namespace shelfbeam {

/// Calls `use(begin, end)` for every edge of a polygon, in the order of its corners.
template <class Use>
void each_edge(const Polygon& polygon, Use use) {
  for (std::size_t k = 0; k < polygon.size(); ++k) use(polygon[k], polygon[(k + 1) % polygon.size()]);
}

}  // namespace shelfbeam
