#pragma once

#include <array>
#include <cstddef>

#include "shelfbeam/base/names.hpp"

namespace shelfbeam {

/// The question that a selection answers which need not reach all labels.
enum class ReachGoal {
  given,    ///< the user gives the selection
  at_most,  ///< most labels with at most so many units
  share     ///< fewest units that reach a share of the labels
};

template <>
inline constexpr auto names_of<ReachGoal> = std::to_array<Named<ReachGoal>>(
    {{"given", ReachGoal::given}, {"at_most", ReachGoal::at_most}, {"share", ReachGoal::share}});

struct PartialReach {
  ReachGoal goal = ReachGoal::given;
  double value = 0;         ///< at_most: number of units, installed ones included; share: of the labels
  std::size_t reached = 0;  ///< labels, on the signals of the placement
  /// Proven: at_most: no selection of so many units reaches more; share: no selection at all. given: all.
  std::size_t max_reached = 0;
};

}  // namespace shelfbeam
