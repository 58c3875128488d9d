#pragma once

#include <string>
#include <vector>

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/transport/world/path_rules.hpp"

namespace shelfbeam {

/// The kinds of light that a strategy cannot find in this scene and leaves out of the signals, a sentence
/// each; empty where every path is covered. A point transceiver (for particles: a point label) is joined to a
/// surface or label straight, through panes and over one plane mirror; longer ways over mirrors and through
/// solid glass end at a point that no random direction meets.
std::vector<std::string> uncovered_light(const Scene& scene, Strategy strategy = Strategy::mis);

/// The kinds of light that a strategy finds only by chance, a sentence each: standard errors are large, and
/// entries that rest on little of it are flagged (SignalMatrix::flags).
std::vector<std::string> chance_light(const Scene& scene, Strategy strategy = Strategy::mis);

}  // namespace shelfbeam
