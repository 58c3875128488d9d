#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "shelfbeam/base/control.hpp"
#include "shelfbeam/placement/answer/placement.hpp"
#include "shelfbeam/placement/answer/reach_curve.hpp"

namespace shelfbeam {

/// A point for every number of units from the installed ones (at least 1) to those of `selected`, which meets
/// every label. The first column comes from the greedy method forwards and from the selection backwards, the
/// second from ReachBound. Large tables get fewer steps, so that 20 million entries take about a minute; it
/// ends early, with wider points, where `until` comes.
ReachCurve reach_curve(
    const SignalTable& table, const Question& question, const std::vector<std::uint32_t>& selected,
    const RunControl& control = {},
    std::chrono::steady_clock::time_point until = std::chrono::steady_clock::time_point::max());

/// Lets a placement and the curve that began with its selection take over what the other knows: fewer units
/// that meet every label (lexicographic questions, where the selection need not stay), a higher bound of
/// their number, and that fewer than this bound miss a label.
void agree(Placement& placement, ReachCurve& curve, const SignalTable& table, bool selection_stays = false);

/// The curve of a placement that has a selection, made in what this has left of the limit, but in a tenth of
/// it at least; both agree then, and the placement's seconds have grown.
ReachCurve add_curve(Placement& placement, const SignalTable& table, double time_limit_s,
                     const RunControl& control = {}, bool selection_stays = false);

}  // namespace shelfbeam
