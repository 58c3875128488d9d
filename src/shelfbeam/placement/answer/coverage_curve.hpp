#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace shelfbeam {

/// What a number of units can do: some selection of at most so many meets at least so many labels, and none
/// meets more than at most so many.
struct CurvePoint {
  std::size_t units = 0;
  std::size_t at_least = 0;  ///< labels
  std::size_t at_most = 0;   ///< labels, proven
};

struct ReachCurve {
  std::vector<CurvePoint> points;       ///< one for every number of units; neither column falls
  std::vector<std::uint32_t> selected;  ///< the fewest units seen that meet every label; ascending
  bool is_complete = true;              ///< no interruption and no limit cut it short
};

}  // namespace shelfbeam
