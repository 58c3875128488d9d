#pragma once

#include <string>

#include "shelfbeam/transport/run/simulation_summary.hpp"

namespace shelfbeam::app {

/// A few lines: size, effort and errors of the simulation. If a certificate decides where more samples are
/// taken, they say so instead of predicting the time for smaller errors.
std::string describe(const SimulationSummary& summary, bool follows_decision = false);

}  // namespace shelfbeam::app
