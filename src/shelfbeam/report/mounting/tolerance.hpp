#pragma once

#include <vector>

#include "shelfbeam/report/data/report.hpp"

namespace shelfbeam {

/// For each chosen unit, the distance in plan, in m, by which it may be off its position; 0: nothing is
/// known, or the signals leave no room. All units may be off at once, each in any direction, and every label
/// that is reached stays so.
///
/// An estimate: the loss of signal per metre is that towards the neighbouring candidates of the same type,
/// height and axis, one in each direction along x and y and at most `max_neighbour` away, times
/// `loss_factor`. An installed unit stays where it is. In a plan for a changing shop, the signals of the
/// shop as the file gives it decide nothing, so all are 0.
std::vector<double> tolerances_of(const ReportInput& input);

inline constexpr double max_neighbour = 2.5;  ///< m
inline constexpr double loss_factor = 2;      ///< because signals are not linear between two candidates

}  // namespace shelfbeam
