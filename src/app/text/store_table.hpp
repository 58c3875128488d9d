#pragma once

#include "shelfbeam/scene/scene.hpp"
#include "shelfbeam/signal/tables/signal_table.hpp"

namespace shelfbeam::app {

/// What placements are asked about, before there is any signal: labels and candidates of a scene.
SignalTable table_without_signals(const Scene& scene);

}  // namespace shelfbeam::app
