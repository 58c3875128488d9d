#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/instance.hpp"

namespace shelfbeam {

/// What a number of units can do: some selection of at most so many meets at least so many labels, and none
/// meets more than at most so many.
struct CurvePoint {
  std::size_t units = 0;
  std::size_t at_least = 0;  ///< labels
  std::size_t at_most = 0;   ///< labels, proven
};

/// One point for every number of units from the installed ones (at least 1) to those of the selection, which
/// meets every label; neither column falls. The first comes from the greedy method forwards and from the
/// selection backwards, the second from ReachBound. Large tables get fewer steps, so that 20 million entries
/// take about a minute.
std::vector<CurvePoint> reach_curve(const SignalTable& table, const Question& question,
                                    const std::vector<std::uint32_t>& selected,
                                    const RunControl& control = {});

}  // namespace shelfbeam
