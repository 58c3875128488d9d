#pragma once

#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// One sentence for each kind of light that a strategy cannot find in this scene and omits from the signals;
/// empty if every path is covered. A connection joins a point transceiver (for particles: a point label) to a
/// surface or label: straight, through panes, or over one plane mirror. Longer paths over mirrors and paths
/// through solid glass end at a point that no random direction meets.
std::vector<std::string> uncovered_light(const Scene& scene, Strategy strategy = Strategy::mis);

/// One sentence for each kind of light that a strategy finds only by chance. Such light has large standard
/// errors, and entries that rest on a few such paths are flagged (SignalMatrix::flags).
std::vector<std::string> chance_light(const Scene& scene, Strategy strategy = Strategy::mis);

}  // namespace shelfbeam
